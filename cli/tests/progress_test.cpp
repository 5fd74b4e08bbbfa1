// The progress of a long job on a terminal: within its width, with the time left, gone before anything else.

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

using namespace hts::cli::testing;
using Clock = std::chrono::steady_clock;

constexpr unsigned short columns = 44;
const std::string erasing = "\r\033[K";

/// `hts` whose standard output and error are a terminal of so many columns.
class OnTerminal {
  public:
    OnTerminal(const Workplace& place, const std::string& arguments) {
        winsize size{24, columns, 0, 0};
        process_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
        REQUIRE(process_ >= 0);
        if (process_ != 0) return;
        const std::string command =
            "cd '" + place.folder().string() + "' && exec '" HTS_COMMAND "' " + arguments;
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    ~OnTerminal() { ::close(terminal_); }
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    /// Reads until what was seen holds the words, or the end; whether it does.
    bool sees(const std::string& words) {
        const auto end = Clock::now() + std::chrono::seconds{120};
        while (seen_.find(words) == std::string::npos) {
            pollfd one{terminal_, POLLIN, 0};
            if (Clock::now() > end) return false;
            if (::poll(&one, 1, 1000) <= 0) continue;
            std::array<char, 4096> part{};
            const ssize_t size = ::read(terminal_, part.data(), part.size());
            if (size <= 0) return false;  // the command has ended
            seen_.append(part.data(), static_cast<std::size_t>(size));
        }
        return true;
    }
    void signal(int number) const { ::kill(process_, number); }
    /// All that was written, once the command has ended.
    std::string all() {
        while (sees("\x01")) {
        }
        ::waitpid(process_, nullptr, 0);
        return seen_;
    }

  private:
    int terminal_ = -1;
    pid_t process_ = -1;
    std::string seen_;
};

/// What stands between erasures: the lines that were drawn, and what came after the last one.
std::vector<std::string> pieces(const std::string& text) {
    std::vector<std::string> result;
    for (std::size_t from = 0;;) {
        const auto to = text.find(erasing, from);
        result.push_back(text.substr(from, to == std::string::npos ? to : to - from));
        if (to == std::string::npos) return result;
        from = to + erasing.size();
    }
}

const std::string m = "-m '" HTS_SOURCE_DIR "/cli/data/rough-aluminium.json'";

}  // namespace

TEST_CASE("progress: drawn with the time left, within the width, and gone when a signal ends the run") {
    for (const std::string& arguments : std::vector<std::string>{
             "furnace --output new",
             "truth moments --output new",
             "validate --only moments --output new",
             "eval " + m + " --wavelengths 0.4:0.7:31 --random-pairs 1000000000",
             "sample " + m + " --wavelength 2 --theta-i 45 --count 1000000000 -o a.csv",
             "albedo " + m + " --wavelengths 0.4:0.7:2000",
             "table chart " + m + " --samples 200000",
             "table export " + m + " --format rgl -o b.bsdf",
             "chart -o new",
             "fit --all-models anodised-ec1 anodised-ec2 curet-sandpaper --starts 512 -o f.csv",
             "render fig14 --size 2048 --samples 4096 -o a.png",
         }) {
        INFO(arguments);
        const Workplace place;
        OnTerminal command{place, arguments};
        CHECK(command.sees(" left"));
        command.signal(SIGTERM);
        const auto lines = pieces(command.all());
        CHECK(lines.size() > 2);
        CHECK(lines.back().empty());
        // what a study has solved stays, and the next run goes on from it
        const bool resumes = arguments.starts_with("truth");
        CHECK(place.names() == (resumes ? std::vector<std::string>{"new"} : std::vector<std::string>{}));
        if (resumes) CHECK_FALSE(place.read("new/moments.unfinished").empty());
        for (const std::string& line : lines) {
            INFO(line);
            CHECK(line.size() < columns);
            CHECK(line.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("progress: the answer stands where the line was") {
    const Workplace place;
    OnTerminal command{place, "sample " + m + " --wavelength 2 --theta-i 45 --count 1500000 -o a.csv"};
    const auto lines = pieces(command.all());
    CHECK(lines.back().starts_with("hts: mean weight"));
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) CHECK(lines[i].find("mean") == std::string::npos);
}

TEST_CASE("progress: none where standard error is no terminal") {
    const Workplace place;
    const auto result = place.hts("sample " + m + " --wavelength 2 --theta-i 45 --count 1500000 -o a.csv");
    CHECK(result.errors.starts_with("hts: mean weight"));
}
