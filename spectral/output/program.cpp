#include "spectral/output/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "hts/error.hpp"
#include "spectral/text/unfinished.hpp"

namespace hts::output {
namespace {

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> part{};
    for (ssize_t n = 0; (n = ::read(descriptor, part.data(), part.size())) > 0;) {
        text.append(part.data(), static_cast<std::size_t>(n));
    }
    return text;
}

}  // namespace

Ended run_program(std::vector<std::string> words, const RunSettings& how) {
    std::array<int, 2> pipe_ends{};
    if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw Error{words.front() + ": no pipe can be opened"};
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
    posix_spawn_file_actions_addchdir_np(&actions, how.folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    if (how.with_messages)
        posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    else
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int failure =
        ::posix_spawnp(&process, words.front().c_str(), &actions, &attributes, arguments.data(), environ);
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

}  // namespace hts::output
