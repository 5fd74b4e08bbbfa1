// What the command has of its system and the page has not: libpng, other programs that use
// the same files, threads.

#include "hts/error.hpp"
#include "spectral/text/png.hpp"
#include "spectral/text/run_files.hpp"

namespace hts::spectral {

ValueGrid read_png_luminance(const std::filesystem::path& path) {
    throw Error{path.string() + ": pictures of normals are not read in the page; the command hts reads them"};
}

std::filesystem::path path_to_read(const std::filesystem::path& path) {
    return path;
}

}  // namespace hts::spectral

extern "C" {
int omp_in_parallel() {
    return 0;
}
int omp_get_level() {
    return 0;
}
int omp_get_thread_num() {
    return 0;
}
}
