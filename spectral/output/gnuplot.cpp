#include "spectral/output/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "hts/error.hpp"
#include "spectral/output/script.hpp"
#include "spectral/output/svg.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::output {
namespace {

namespace fs = std::filesystem;

/// How a program ended and what it said.
struct Ended {
    int status;
    std::string messages;
};

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t n = 0; (n = ::read(descriptor, part.data(), part.size())) > 0;) {
        text.append(part.data(), static_cast<std::size_t>(n));
    }
    return text;
}

/// Runs gnuplot on a script in a folder; status -1 if it cannot be run.
Ended run_gnuplot(const std::string& folder, const std::string& definitions, const std::string& script) {
    std::array<int, 2> pipe_ends{};
    if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw Error{"gnuplot: no pipe can be opened"};
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // gnuplot does not look whether the medium took all: a limit must end it
    sigset_t ending;
    ::sigemptyset(&ending);
    ::sigaddset(&ending, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &ending);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    std::array<std::string, 4> words{"gnuplot", "-e", definitions, script};
    const std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                         nullptr};
    pid_t process = 0;
    const int failure = ::posix_spawnp(&process, "gnuplot", &actions, &attributes, arguments.data(), environ);
    if (failure == 0) spectral::set_helper_process(process);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    ::close(pipe_ends[1]);
    Ended ended{-1, failure == 0 ? read_all(pipe_ends[0]) : ""};
    ::close(pipe_ends[0]);
    if (failure == 0) ::waitpid(process, &ended.status, 0);
    spectral::set_helper_process(0);
    return ended;
}

std::string one_line(std::string text) {
    for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
    const auto first = text.find_first_not_of(" ^");
    return first == std::string::npos ? "no message" : text.substr(first, 300);
}

/// gnuplot ends well even where the medium was full.
bool is_whole(const fs::path& svg) {
    constexpr std::string_view end = "</svg>";
    std::ifstream file{svg, std::ios::binary | std::ios::ate};
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
    std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(size, 64)), '\0');
    file.seekg(size - static_cast<std::streamoff>(tail.size()));
    file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    return tail.find(end) != std::string::npos;
}

/// Whether the medium took all of the finished picture.
bool finish(const fs::path& svg) {
    std::ostringstream text;
    text << std::ifstream{svg, std::ios::binary}.rdbuf();
    std::ofstream file{svg, std::ios::binary | std::ios::trunc};
    file << finished_svg(text.str());
    file.close();
    return static_cast<bool>(file);
}

std::string head(const std::string& picture) {
    return "# run `gnuplot` on this file, in its folder, to draw it again\n"
           "if (!exists('picture')) picture = " +
           gnuplot_string(gnuplot_file(picture)) +
           "\n"
           "set encoding utf8\n"
           "set terminal svg size 900,600 font 'Helvetica,15' background '#ffffff'\n"
           "set output picture\n" +
           std::string{script_file("style")};
}

}  // namespace

void require_gnuplot(const std::string& svg_path) {
    const char* const path = std::getenv("PATH");
    const auto folders = spectral::split(path != nullptr ? path : "/bin:/usr/bin", ':');
    const auto holds_gnuplot = [](std::string_view folder) {
        return ::access((fs::path{folder} / "gnuplot").c_str(), X_OK) == 0;
    };
    if (std::ranges::none_of(folders, holds_gnuplot))
        throw Error{svg_path + ": gnuplot not found: must be installed to draw (apt install gnuplot-nox)"};
}

void draw(const std::string& svg_path, std::string_view script) {
    require_gnuplot(svg_path);
    const fs::path svg{svg_path};
    const fs::path script_path = fs::path{svg}.replace_extension(".gnuplot");
    const std::string name = svg.filename().string();
    spectral::write_file(script_path.string(), head(name) + std::string{script});

    std::optional<spectral::RunFiles> own;
    auto* files = spectral::RunFiles::of_process();
    if (files == nullptr) files = &own.emplace();
    const fs::path picture{files->open(svg_path)};
    // Numbers of the same run stand where the picture is made, others one folder up. The picture's own name
    // may be one that gnuplot cannot write.
    const fs::path drawn = picture.parent_path() / ".picture.svg";
    const spectral::Unfinished unfinished{drawn.string(), spectral::Unfinished::Kind::file};
    const Ended ended =
        run_gnuplot(picture.parent_path().string(), "set loadpath '..'; picture = '.picture.svg'",
                    fs::absolute(spectral::path_to_read(script_path)).string());
    std::error_code failure;
    if (ended.status == 0 && is_whole(drawn) && finish(drawn)) fs::rename(drawn, picture, failure);
    if (ended.status == 0 && !failure && fs::exists(picture)) {
        files->complete(svg_path);
        if (own) own->commit();
        return;
    }
    fs::remove(drawn, failure);
    files->drop(svg_path);
    throw Error{svg_path + ": gnuplot failed: " + one_line(ended.messages)};
}

}  // namespace hts::output
