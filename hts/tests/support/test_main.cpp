#define CATCH_CONFIG_RUNNER
#include <cstdlib>

#include <catch2/catch.hpp>

int main(int argc, char** argv) {
    setenv("HTS_CACHE", "off", 1);  // of the commands that tests run: tables of another build must not answer
    return Catch::Session().run(argc, argv);
}
