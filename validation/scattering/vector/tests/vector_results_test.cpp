#include "validation/scattering/vector/vector_results.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "temporary_folder.hpp"
#include "validation/scattering/vector/vector_report.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;

VectorSettings small() {
    VectorSettings settings;
    settings.length = 8;
    settings.theta_i_deg = {30};
    return settings;
}

double sum(const Channels& of) {
    return of[Channel::ss] + of[Channel::sp] + of[Channel::ps] + of[Channel::pp];
}

}  // namespace

TEST_CASE("vector results: the closed forms are those of the models, and Kirchhoff's conserves") {
    const Surface surface{0.2, 1};
    const ClosedForms forms{surface};
    const HeUnifiedSpectrum unified{
        surface, {{Wavelength::from_micrometres(1), perfect_conductor(), 0}}, Tolerance{1e-12}};
    const HeTorranceSpectrum he{
        surface, {{Wavelength::from_micrometres(1), perfect_conductor(), 0}}, Tolerance{1e-12}};
    const Direction in = Direction::from_degrees(40, 180);
    for (const double phi : {0.0, 50.0, 130.0}) {
        const Direction out = Direction::from_degrees(55, phi);
        const auto lobes = forms.lobes(in, out);
        double value = 0;
        unified.brdf({in, out}, {&value, 1});
        CHECK(sum(lobes[3]) / 2 == Approx(value * out.cos_theta()).epsilon(1e-9));
        he.brdf({in, out}, {&value, 1});
        CHECK(sum(lobes[2]) / 2 == Approx(value * out.cos_theta()).epsilon(1e-4));
        // Smith's shadowing takes away
        CHECK(sum(lobes[1]) < sum(lobes[0]));
    }
    // a smooth wide surface reflects all that it does not mirror, but for what goes below the horizon
    const ClosedForms gentle{Surface{0.2, 4}};
    Channels all;
    for (int i = 0; i < 90; ++i) {
        for (int j = 0; j < 180; ++j) {
            const double theta = (i + 0.5) * degree;
            all.add(std::sin(theta) * degree * 2 * degree,
                    gentle.lobes(in, Direction::from_angles(theta, 2 * j * degree))[0]);
        }
    }
    const double g = std::pow(2 * 2 * pi * 0.2 * std::cos(40 * degree), 2);
    CHECK(sum(all) / 2 == Approx(1 - std::exp(-g)).epsilon(0.01));
}

TEST_CASE("vector results: Kirchhoff's currents on realisations have the mean of the closed form") {
    const VectorSurface surface{0.1, {0.8, 0.8}};
    std::vector<VectorRealisation> all;
    for (std::size_t i = 0; i < 12; ++i) all.push_back(realisation(surface, small(), i));
    const auto results = vector_results(surface, small(), all);
    REQUIRE(results.size() == 1);
    const VectorResult& result = results[0];
    std::printf("energy %.4f %.4f, mirror %.4f %.4f, Kirchhoff %.2f dB, gain %.1f, %.1f products\n",
                result.energy[0], result.energy[1], result.mirror[0], result.mirror[1], result.kirchhoff_db,
                result.gain, result.iterations);
    CHECK(result.energy[0] == Approx(1).epsilon(0.03));
    CHECK(result.energy[1] == Approx(1).epsilon(0.03));
    CHECK(result.kirchhoff_db < 1);
    CHECK(result.gain > 1.5);
    // coherent and incoherent parts are all there is
    double incoherent = 0;
    for (const VectorBin& bin : result.bins)
        incoherent += bin.solid_angle() * (bin.exact[Channel::ss] + bin.exact[Channel::ps]);
    CHECK(incoherent + result.mirror[0] == Approx(result.energy[0]).epsilon(0.05));
    const double g = std::pow(2 * 2 * pi * 0.1 * std::cos(30 * degree), 2);
    CHECK(result.mirror[0] == Approx(std::exp(-g)).epsilon(0.25));
    // a gentle surface: the successor is within the errors of so few realisations
    std::vector<Channels> unified;
    for (const auto& bin : binned(ClosedForms{surface.surface()}, result.of, small()))
        unified.push_back(bin[3]);
    const VectorDistance off = distance(result.bins, unified, VectorLight::unpolarised, VectorRegion::all);
    std::printf("he_unified %.2f dB off, chance %.2f dB\n", off.rms, off.chance);
    CHECK(off.rms < 1.5);
}

TEST_CASE("vector results: hts info has the distances of the lobes that are kept") {
    const FigureTable table = kept_vector_distances().by_case;
    const auto kept = spectral::CsvTable::read(HTS_SOURCE_DIR "/spectral/energy/data/vector-distances.csv");
    REQUIRE(kept.row_count() == table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        for (std::size_t column = 0; column < table.columns.size(); ++column)
            CHECK(kept.number(row, kept.column(table.columns[column])) ==
                  Approx(table.rows[row][column]).epsilon(2e-3));
    }
}

TEST_CASE("vector results: a distance is the weighted rms in decibels of the bins that count") {
    std::vector<VectorBin> bins = vector_bins();
    std::vector<Channels> model(bins.size());
    double whole = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        whole += bins[i].solid_angle();
        for (const Channel c : channels) {
            bins[i].exact[c] = 1;
            bins[i].error[c] = 0.1;
            model[i][c] = bins[i].most_theta_deg > 80 ? 100 : c == Channel::pp ? 2 : 1;
        }
    }
    CHECK(whole == Approx(2 * pi));
    CHECK(distance(bins, model, VectorLight::ss, VectorRegion::all).rms == Approx(0).margin(1e-12));
    const VectorDistance pp = distance(bins, model, VectorLight::pp, VectorRegion::in_plane);
    CHECK(pp.rms == Approx(10 * std::log10(2)));
    CHECK(pp.bias == Approx(pp.rms));
    CHECK(pp.chance == Approx(0.4343).epsilon(1e-3));
    CHECK(distance(bins, model, VectorLight::unpolarised, VectorRegion::all).rms ==
          Approx(10 * std::log10(1.25)));
}

TEST_CASE("vector results: a realisation's file gives back what was written, and nothing else") {
    const testing::TemporaryFolder folder;
    const VectorSurface surface{0.1, {1, 0.6}, 4};
    VectorSettings settings = small();
    settings.length = 5;
    const RealisationFile file{folder.path(), surface, settings, 3};
    CHECK_FALSE(file.exists());
    const VectorRealisation solved = realisation(surface, settings, 3);
    REQUIRE(solved.grids.size() == 2);  // both planes of incidence
    file.write(solved);
    REQUIRE(file.exists());
    const VectorRealisation back = file.read();
    CHECK(back.iterations == solved.iterations);
    for (std::size_t grid = 0; grid < 2; ++grid) {
        for (std::size_t i = 0; i < back.grids[grid].size(); ++i)
            REQUIRE(back.grids[grid][i].exact == solved.grids[grid][i].exact);
    }
    settings.tolerance = 1e-4;
    CHECK_THROWS_WITH((RealisationFile{folder.path(), surface, settings, 3}.read()),
                      Catch::Contains("is of another run of this study") && Catch::Contains(".part"));
    settings.tolerance = 1e-3;
    const auto path = std::filesystem::directory_iterator {
        folder.path()
        } -> path();
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
    CHECK_THROWS_WITH(file.read(), Catch::Contains("is damaged"));
    CHECK_THROWS_WITH(vector_study(folder.path(), vector_side),
                      Catch::Contains("0 realisations of the surface sigma0 0.05") &&
                          Catch::Contains("must be at least 10"));
    CHECK_THROWS_WITH(vector_results(surface, settings, {solved}), Catch::Contains("at least 3"));
}
