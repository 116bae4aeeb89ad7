// Contains the test runner's main function, in a file of its own because Catch2 2 takes long to compile it.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
