#include "tables/sharing/table_parts.hpp"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "tables/sharing/slice_file.hpp"
#include "tables/table/tests/table_fixture.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using namespace hts::tables::testing;
using hts::testing::TemporaryFolder;
namespace fs = std::filesystem;

/// The quickest of jobs.
const TableJob& job() {
    static const TableJob job{{"plaster", R"({"model": "lambert", "diffuse_albedo": 0.5})", "plaster.json"},
                              {0.5},
                              {.tolerance = 0.1}};
    return job;
}

const spectral::Reflectance& exact() {
    static const auto exact = exact_model(job());
    return exact;
}

const std::string& whole() {
    static const std::string bytes =
        finished_table(exact(), job().source, plan_table(exact(), job().request), computed_slices(exact()));
    return bytes;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

void build(const fs::path& path, const TableShard& shard = {}, const TableJob& wanted = job()) {
    build_table_file(exact(), wanted, path, shard, threads_worker(exact()));
}

/// A worker that gives up after some slices, as a process that is killed does.
SliceWorker interrupted_after(std::size_t count) {
    return [count](const TablePlan& plan, std::span<const std::size_t> slices, const auto& keep) {
        for (std::size_t i = 0; i < count; ++i) keep(slices[i], table_slice(exact(), plan, slices[i]));
        throw std::runtime_error{"interrupted"};
    };
}

}  // namespace

TEST_CASE("a build that was interrupted goes on, to the same bytes") {
    const TemporaryFolder folder;
    const fs::path target = folder / "m.htst", slices = folder / "m.htst.slices";
    const auto interrupt = [&] {
        CHECK_THROWS(build_table_file(exact(), job(), target, {}, interrupted_after(3)));
        CHECK_FALSE(fs::exists(target));
        REQUIRE(fs::exists(slices));
    };
    std::size_t computed = 0;
    const auto go_on = [&] {
        build_table_file(exact(), job(), target, {},
                         [&](const TablePlan& plan, std::span<const std::size_t> missing, const auto& keep) {
                             computed = missing.size();
                             threads_worker(exact())(plan, missing, keep);
                         });
        CHECK(bytes_of(target) == whole());
        CHECK(folder.size() == 1);
        fs::remove(target);
    };
    const std::size_t all = Table::from_bytes(whole(), "whole").info().nodes.grazing;
    interrupt();
    go_on();
    CHECK(computed == all - 3);

    interrupt();
    fs::resize_file(slices, fs::file_size(slices) - 100);  // in the middle of a slice
    go_on();
    CHECK(computed == all - 2);

    interrupt();
    fs::resize_file(slices, 50);  // in the middle of the header
    go_on();
    CHECK(computed == all);
}

TEST_CASE("shards, merged in any order, are the table, and what lacks or does not belong is named") {
    const TemporaryFolder folder;
    build(folder / "1", {1, 3});
    build(folder / "2", {2, 3});
    build(folder / "3", {3, 3});
    TableJob another = job();
    another.request.seed = 9;
    build(folder / "other", {2, 3}, another);
    CHECK(folder.size() == 4);
    const auto merge = [&](const std::vector<const char*>& names) {
        std::vector<fs::path> parts;
        for (const char* name : names) parts.push_back(folder / name);
        return error_of([&] {
            merge_table_file(parts, folder / "m.htst");
            return 0;
        });
    };
    CHECK(merge({"3", "1", "2"}).empty());
    CHECK(bytes_of(folder / "m.htst") == whole());
    CHECK_THAT(merge({"1", "3"}), Catch::Contains("part 2/3 is missing"));
    CHECK_THAT(merge({"2"}), Catch::Contains("part 1/3, 3/3 is missing"));
    CHECK_THAT(merge({"1", "other", "3"}), Catch::Contains("other: is a part of another table than"));
    CHECK_THAT(merge({"1", "m.htst"}), Catch::Contains("m.htst: is no part of a table"));
    fs::resize_file(folder / "2", fs::file_size(folder / "2") - 1);
    CHECK_THAT(merge({"1", "2", "3"}), Catch::Contains("part 2/3 is missing or not finished"));
    fs::resize_file(folder / "2", 100);
    CHECK_THAT(merge({"1", "2", "3"}), Catch::Contains("cut short"));
    CHECK_THAT(error_of([&] {
                   build(folder / "4", {4, 3});
                   return 0;
               }),
               Catch::Contains("shard 4/3: must be k/N"));
    CHECK(TableShard::from_text("2/3") == TableShard{2, 3});
    CHECK(TableShard{2, 3}.slices(8) == std::vector<std::size_t>{1, 4, 7});
    for (const char* text : {"", "2", "0/3", "4/3", "a/3", "1/3/3", "1/", "-1/3"})
        CHECK_THROWS_AS(TableShard::from_text(text), hts::Error);
}

TEST_CASE(
    "a table whose error misses is refined by itself, to the same bytes by shards and after an "
    "interruption") {
    const TableJob job{small_job().source, {0.55}, {.tolerance = 5e-2}};
    const spectral::Reflectance exact = exact_model(job);
    TablePlan coarse = plan_table(exact, job.request);
    coarse.nodes.ratio = coarse.nodes.ratio / 2 + 1;
    const std::string once = finished_table(exact, job.source, coarse, computed_slices(exact));
    const Table table = Table::from_bytes(once, "refined");
    CHECK(table.info().error.largest <= job.request.tolerance);
    CHECK(table.info().nodes.ratio > coarse.nodes.ratio);

    const TemporaryFolder folder;
    const auto build_from = [&](const char* name, const TableShard& shard, const SliceWorker& worker) {
        const fs::path path = folder / name;
        const std::string slices = path.string() + ".slices";
        if (!fs::exists(slices)) {
            std::ofstream{slices, std::ios::binary} << part_header_bytes({job, coarse, shard});
        }
        build_table_file(exact, job, path, shard, worker);
        return path;
    };
    const SliceWorker interrupted = [&](const TablePlan& plan, std::span<const std::size_t> slices,
                                        const auto& keep) {
        if (plan.refinements == 0) return threads_worker(exact)(plan, slices, keep);
        keep(slices[0], table_slice(exact, plan, slices[0]));
        throw std::runtime_error{"interrupted"};
    };
    CHECK_THROWS_WITH(build_from("m", {}, interrupted), "interrupted");
    CHECK(bytes_of(build_from("m", {}, threads_worker(exact))) == once);

    std::vector<fs::path> parts;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
        parts.push_back(build_from(k == 1 ? "1" : "2", {k, 2}, threads_worker(exact)));
    }
    merge_table_file(parts, folder / "merged");
    CHECK(bytes_of(folder / "merged") == once);

    coarse.refinements = 3;
    CHECK_THAT(error_of([&] { return finished_table(exact, job.source, coarse, computed_slices(exact)); }),
               Catch::Contains("refined 3 times: must be at most the tolerance 0.05"));
    coarse.refinements = 0;
    coarse.request.largest_bytes = 1000;
    CHECK_THAT(error_of([&] { return finished_table(exact, job.source, coarse, computed_slices(exact)); }),
               Catch::Contains("must be one that 1000 bytes can meet"));
}
