#include "cli/io/signals.hpp"

#include <csignal>

#include "spectral/text/output.hpp"

namespace hts::cli {
namespace {

extern "C" void remove_partial_files_and_end(int signal) {
    spectral::remove_partial_files();
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

}  // namespace

void remove_partial_files_on_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        static_cast<void>(std::signal(signal, remove_partial_files_and_end));
    }
}

}  // namespace hts::cli
