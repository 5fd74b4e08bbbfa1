/// What the system may do to a run: signals, streams that are closed.
#pragma once

namespace hts::cli {

/// From here on a signal that ends the program, SIGINT, SIGTERM, SIGHUP and their like, removes the files
/// under construction first. A signal that is ignored, as SIGHUP is under nohup, stays ignored. A file that
/// reaches the limit of the shell (SIGXFSZ) becomes the error of the write that met it.
void remove_partial_files_on_signals();

/// A standard stream that is closed stays unusable: no file that is opened later takes its number.
void keep_standard_streams();

}  // namespace hts::cli
