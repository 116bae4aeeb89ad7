cd /work/worlds
g++ -std=c++20 -O2 -fsyntax-only -I. -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-restrict -Werror fast/worlds/instantiate.cpp fast/worlds.cpp -x c++ 2>&1 | grep -E "error|required from here" | head -30
