#include "cli/io/signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "cli/io/progress.hpp"
#include "spectral/text/output.hpp"

namespace hts::cli {
namespace {

extern "C" void remove_partial_files_and_end(int signal) {
    erase_progress();
    spectral::remove_partial_files();
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

/// Those that end a program and come from outside.
constexpr std::array ending{SIGHUP,  SIGINT,  SIGQUIT, SIGPIPE, SIGALRM,
                            SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM};

bool is_default(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

}  // namespace

void remove_partial_files_on_signals() {
    for (const int signal : ending) {
        if (is_default(signal)) static_cast<void>(std::signal(signal, remove_partial_files_and_end));
    }
    if (is_default(SIGXFSZ)) static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}

void keep_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0) continue;
        static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
}

}  // namespace hts::cli
