#include "spectral/parallel.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "hts/error.hpp"

using namespace hts::spectral;

TEST_CASE("a parallel loop visits each index once, alone and in blocks") {
    for (const std::size_t count : {0U, 1U, 7U, 1000U}) {
        std::vector<int> alone(count), blocks(count);
        parallel_for(count, [&](std::size_t i) { ++alone[i]; });
        parallel_blocks(count, 7, [&](std::size_t first, std::size_t number) {
            for (std::size_t i = first; i < first + number; ++i) ++blocks[i];
        });
        CHECK(alone == std::vector(count, 1));
        CHECK(blocks == alone);
    }
}

TEST_CASE("a loop that is asked to stop leaves out what is left") {
    static int asked;
    asked = 0;
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    stop_jobs_where([] { return ++asked == 3; });
    int done = 0;
    CHECK_THROWS_AS(parallel_for(100, [&](std::size_t /*i*/) { ++done; }), Stopped);
    CHECK(done == 3);
    stop_jobs_where(nullptr);
    parallel_for(100, [&](std::size_t /*i*/) { ++done; });
    CHECK(done == 103);
    omp_set_num_threads(before);
}

TEST_CASE("the failure of the lowest index is thrown, for any number of threads") {
    const int before = omp_get_max_threads();
    for (const int threads : {1, 3}) {
        omp_set_num_threads(threads);
        const auto work = [](std::size_t i) {
            if (i % 10 == 3) throw hts::Error{std::to_string(i)};
        };
        CHECK_THROWS_WITH(parallel_for(100, work), "3");
    }
    omp_set_num_threads(before);
}
