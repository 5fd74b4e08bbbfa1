#include "spectral/jobs/progress.hpp"

#include <catch2/catch.hpp>

#include "spectral/parallel.hpp"

using namespace hts::spectral;

namespace {

int cleared = 0;

/// Watches for as long as it lives.
struct Watch {
    Watch() {
        cleared = 0;
        watch_jobs([] { ++cleared; });
    }
    ~Watch() { watch_jobs(nullptr); }
};

}  // namespace

TEST_CASE("a job that nobody watches is nothing") {
    const Job job{"work", 3};
    job.done();
    CHECK_FALSE(job_state());
}

TEST_CASE("a job inside another one counts as a share of the outer one's next part") {
    const Watch watch;
    {
        Job outer{"outer", 4};
        outer.done();
        CHECK(job_state()->share == 0.25);
        {
            const Job inner{"inner", 10}, unnamed{"", 2};
            inner.set_done(5);
            unnamed.done();
            CHECK(job_state()->step == "inner");
            CHECK(job_state()->share == Approx((1 + (5 + 0.5) / 10) / 4));
            CHECK(job_state()->first_begun <= job_state()->begun);
        }
        CHECK(cleared == 0);
        CHECK(job_state()->step == "outer");
        outer.restart("again");
        CHECK(job_state()->step == "again");
        CHECK(job_state()->share == 0);
    }
    CHECK(cleared == 1);
    CHECK_FALSE(job_state());
}

TEST_CASE("a job of one part is as far as what is inside it, and of unknown parts, nobody knows") {
    const Watch watch;
    const Job outer{"verb", 1};
    {
        const Job inner{"", 4};
        inner.done();
        CHECK(job_state()->step == "verb");
        CHECK(job_state()->share == 0.25);
    }
    const Job unknown{"", 0};
    unknown.done(7);
    CHECK(job_state()->share == 0);
}

TEST_CASE("a parallel loop is a job, and loops inside it are none") {
    const Watch watch;
    parallel_for(1, [](std::size_t) { CHECK(job_state().has_value()); });
    const Job outer{"", 10};
    parallel_for(8, [](std::size_t) { parallel_for(8, [](std::size_t) {}); });
    CHECK(job_state()->share == 0);
    outer.done(10);
    CHECK(job_state()->share == 1);
}
