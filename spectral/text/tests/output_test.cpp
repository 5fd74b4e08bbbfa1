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

extern "C" void remove_and_end(int signal) {
    remove_partial_files();
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

TEST_CASE("a program's signal handler removes the files under construction, and leaves those that are done") {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        static_cast<void>(std::signal(SIGTERM, remove_and_end));
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

TEST_CASE("writing a file changes no signal's handler") {
    const TemporaryFolder folder;
    const auto handler = [](int signal) {
        struct sigaction action {};
        REQUIRE(::sigaction(signal, nullptr, &action) == 0);
        return action.sa_handler;
    };
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const auto before = handler(signal);
        const Output output{(folder / "a").string()};
        CHECK(handler(signal) == before);
    }
}

TEST_CASE("an output that another one writes is refused and left alone") {
    const TemporaryFolder folder;
    Output first{(folder / "a").string()};
    first.write("1");
    CHECK_THROWS_AS(Output{(folder / "a").string()}, hts::Error);
    first.commit();
    CHECK(fs::file_size((folder / "a").string()) == 1);
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
