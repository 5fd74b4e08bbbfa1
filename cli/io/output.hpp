/// Output that appears complete or not at all, under the command line's own names.
#pragma once

#include "spectral/text/output.hpp"

namespace hts::cli {

using spectral::Output;
using spectral::write_file;

}  // namespace hts::cli
