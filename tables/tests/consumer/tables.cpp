// Uses hts::tables as installed: a surface as scattered points in CSV, read back.
#include <cstdio>
#include <fstream>

#include <spectral/spectral.hpp>
#include <tables/tables.hpp>

int main() {
    using namespace hts;
    const auto aluminium = spectral::he_torrance_material("rough aluminium", {0.28, 1.77},
                                                          spectral::built_in_optical_constants("Al"));
    const auto exact = aluminium.at(Wavelength::from_micrometres(0.5));
    std::ofstream{"aluminium.csv"} << tables::scatter_csv(exact, tables::csv_grid());
    const tables::BrdfFile file = tables::read_brdf("aluminium.csv");

    const auto light = Direction::from_degrees(30, 0), view = Direction::from_degrees(40, 180);
    const double read = file.brdf.brdf({light, view})[0], expected = exact.brdf({light, view})[0];
    std::printf("%s: %.6f /sr, exact %.6f\n", file.format.c_str(), read, expected);
    return read > 0.9 * expected && read < 1.1 * expected ? 0 : 1;
}
