#include "spectral/text/output.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>

#include "hts/error.hpp"
#include "temporary_folder.hpp"

using namespace hts::spectral;
using hts::testing::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a signal leaves none of the files that are under construction, and those that are done") {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        Output a{(folder / "a").string()}, b{(folder / "b").string()}, c{(folder / "c").string()};
        for (Output* each : {&a, &b, &c}) {
            each->write("half");
            each->flush();
        }
        b.commit();
        static_cast<void>(std::raise(SIGTERM));
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGTERM);
    CHECK(fs::remove((folder / "b").string()));
    CHECK(folder.size() == 0);
}

TEST_CASE("several files are written all or none") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_files({{(folder / "a").string(), "1"}, {(folder / "none/b").string(), "2"}}),
                    hts::Error);
    CHECK(folder.size() == 0);
    write_files({{(folder / "a").string(), "1"}, {(folder / "b").string(), "2"}});
    CHECK(fs::file_size((folder / "a").string()) == 1);
    CHECK(fs::file_size((folder / "b").string()) == 1);
}
