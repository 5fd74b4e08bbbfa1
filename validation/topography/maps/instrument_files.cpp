#include "validation/topography/maps/instrument_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "hts/error.hpp"
#include "spectral/output/program.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

// Rows stand from the top in both packages. Missing heights are NaN, masked, or the greatest number there is.
constexpr auto script = R"(import sys
sys.path = [folder for folder in sys.path if folder]
import array, math

def by_surfalize(path):
    from surfalize import Surface
    surface = Surface.load(path)
    return surface.data, surface.step_x, surface.step_y

def by_surface_topography(path):
    from SurfaceTopography import open_topography
    topography = open_topography(path).topography()
    topography = topography.to_unit('\u00b5m')
    steps = [size / count for size, count in zip(topography.physical_sizes, topography.nb_grid_pts)]
    heights = topography.heights()
    if hasattr(heights, 'filled'): heights = heights.filled(math.nan)
    return heights.T, steps[0], steps[1]

refusals, missing = [], 0
for name, read in ('surfalize', by_surfalize), ('SurfaceTopography', by_surface_topography):
    try:
        rows, step_x, step_y = read(sys.argv[1])
        heights = array.array('d', (float(z) for row in rows for z in row))
        first = next(z for z in heights if abs(z) < 1e100)
        columns = len(rows[0])
        head = ('Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = %.17g\nYReal = %.17g\n'
                'XYUnits = um\nZUnits = um\n'
                % (columns, len(rows), columns * step_x, len(rows) * step_y)).encode()
        head += bytes(4 - len(head) % 4)
        body = array.array('f', (z - first if abs(z) < 1e100 else math.nan for z in heights))
        sys.stdout.buffer.write(head + body.tobytes())
        sys.exit(0)
    except ImportError:
        missing += 1
    except Exception as error:
        refusals.append('%s: %s' % (name, str(error) or type(error).__name__))
print('none' if missing == 2 else '; '.join(refusals))
sys.exit(1)
)";

}  // namespace

bool is_instrument_file(const std::filesystem::path& path) {
    static constexpr std::array<std::string_view, 20> endings{
        ".sdf", ".x3p", ".al3d", ".sur", ".plu", ".plux", ".opd",  ".opdx", ".os3d", ".vk3",
        ".vk4", ".vk6", ".vk7",  ".zon", ".zmg", ".nms",  ".lext", ".tmd",  ".gwy",  ".mnt"};
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::ranges::find(endings, ending) != endings.end();
}

std::string instrument_file_as_gsf(const std::filesystem::path& path) {
    output::Ended ended =
        output::run_program({"python3", "-c", script, path.string()}, {.with_messages = false});
    if (ended.status == 0) return std::move(ended.output);
    if (ended.status == -1 || ended.output == "none\n")
        throw Error{
            "is read by Python: must have python3 with surfalize or SurfaceTopography (pip install "
            "surfalize), or export it as .gsf"};
    std::ranges::replace(ended.output, '\n', ' ');
    throw Error{"by Python: " + std::string{spectral::trimmed(ended.output.substr(0, 300))}};
}

}  // namespace hts::validation
