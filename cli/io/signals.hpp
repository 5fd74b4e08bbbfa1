/// What a signal that ends the program does first.
#pragma once

namespace hts::cli {

/// From here on SIGINT, SIGTERM and SIGHUP remove the files under construction before they end the program. A
/// signal that is ignored, as SIGHUP is under nohup, stays ignored.
void remove_partial_files_on_signals();

}  // namespace hts::cli
