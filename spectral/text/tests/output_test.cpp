#include "spectral/text/output.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>

#include "hts/error.hpp"

using namespace hts::spectral;
namespace fs = std::filesystem;

namespace {

class Folder {
  public:
    Folder() { fs::create_directory(path_); }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] bool empty() const { return fs::is_empty(path_); }

  private:
    fs::path path_ = fs::temp_directory_path() / ("hts-output-test-" + std::to_string(::getpid()));
};

}  // namespace

extern "C" void remove_and_end(int signal) {
    remove_partial_files();
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

TEST_CASE("a program's signal handler removes the files under construction, and leaves those that are done") {
    const Folder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        static_cast<void>(std::signal(SIGTERM, remove_and_end));
        Output a{folder.file("a")}, b{folder.file("b")}, c{folder.file("c")};
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
    CHECK(fs::remove(folder.file("b")));
    CHECK(folder.empty());
}

TEST_CASE("writing a file changes no signal's handler") {
    const Folder folder;
    const auto handler = [](int signal) {
        struct sigaction action {};
        REQUIRE(::sigaction(signal, nullptr, &action) == 0);
        return action.sa_handler;
    };
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const auto before = handler(signal);
        const Output output{folder.file("a")};
        CHECK(handler(signal) == before);
    }
}

TEST_CASE("an output that another one writes is refused and left alone") {
    const Folder folder;
    Output first{folder.file("a")};
    first.write("1");
    CHECK_THROWS_AS(Output{folder.file("a")}, hts::Error);
    first.commit();
    CHECK(fs::file_size(folder.file("a")) == 1);
}

TEST_CASE("several files are written all or none") {
    const Folder folder;
    CHECK_THROWS_AS(write_files({{folder.file("a"), "1"}, {folder.file("none/b"), "2"}}), hts::Error);
    CHECK(folder.empty());
    write_files({{folder.file("a"), "1"}, {folder.file("b"), "2"}});
    CHECK(fs::file_size(folder.file("a")) == 1);
    CHECK(fs::file_size(folder.file("b")) == 1);
}
