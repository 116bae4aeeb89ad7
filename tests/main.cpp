// Holds the test runner's main function; it is a separate translation unit because Catch2 2 takes long to compile it.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
