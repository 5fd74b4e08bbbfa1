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

TEST_CASE("a signal leaves none of the files that are under construction, and those that are done") {
    const Folder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
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

TEST_CASE("several files are written all or none") {
    const Folder folder;
    CHECK_THROWS_AS(write_files({{folder.file("a"), "1"}, {folder.file("none/b"), "2"}}), hts::Error);
    CHECK(folder.empty());
    write_files({{folder.file("a"), "1"}, {folder.file("b"), "2"}});
    CHECK(fs::file_size(folder.file("a")) == 1);
    CHECK(fs::file_size(folder.file("b")) == 1);
}
