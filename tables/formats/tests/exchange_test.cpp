// Every export read back: how much of the reflectance survives, the size of files, and the conventions
// against functions that only survive where both directions are taken right.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/sampling/random.hpp"
#include "materials.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/points/tokens.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/specular_box.hpp"
#include "tables/formats/zemax.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::testing::exhaustive;
using hts::testing::TemporaryFolder;

constexpr double pi = std::numbers::pi;

/// A BRDF written down: f(in, out) at wavelength index k.
class Written final : public spectral::Evaluator {
  public:
    using Function = double (*)(const Direction& in, const Direction& out, std::size_t k);
    Written(Function function, const spectral::WavelengthGrid& wavelengths)
        : spectral::Evaluator{"written", wavelengths}, function_{function} {}
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool above = pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = above ? function_(pair.in, pair.out, k) : 0;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
    }

  private:
    Function function_;
};

spectral::Reflectance written(Written::Function function, const spectral::WavelengthGrid& wavelengths) {
    return spectral::Reflectance{std::make_shared<const Written>(function, wavelengths)};
}

/// Broad lobe about the mirror direction, brighter at one of three wavelengths, dimmer for light from the
/// side: no two directions can be swapped, turned or mirrored without being noticed.
double broad_lobe(const Direction& in, const Direction& out, std::size_t k) {
    const Vector3 m = in.mirror().vector(), v = out.vector();
    return (0.1 + 0.05 * static_cast<double>(k)) * (1.2 + dot(m, v)) * (1 + in.cos_theta() * in.cos_theta());
}
/// One that is the same for swapped directions, as scattered points need it.
double reciprocal_lobe(const Direction& in, const Direction& out, std::size_t k) {
    return (0.1 + 0.05 * static_cast<double>(k)) * (1.2 + dot(in.mirror().vector(), out.vector())) *
           (1 + in.cos_theta() * out.cos_theta());
}
/// The first on a surface with a grain.
double grained_lobe(const Direction& in, const Direction& out, std::size_t k) {
    const Vector3 i = in.vector(), v = out.vector();
    return broad_lobe(in, out, k) * (1 + 0.3 * (i.x + v.x) + 0.2 * i.y);
}

const auto one_wavelength = spectral::WavelengthGrid::from_micrometres({0.633});

spectral::WavelengthGrid rgb() {
    return rgb_wavelengths();
}

RoundTrip compared(const spectral::Reflectance& original, const spectral::Reflectance& read_back) {
    return round_trip(original, read_back, {exhaustive() ? 100'000U : 20'000U, 3});
}

/// Prints the report's essence and checks the bounds of worst and 99 % errors.
void check(const std::string& what, const RoundTrip& trip, double worst, double percentile_99) {
    std::cout << what << ": worst " << trip.worst.error << " of peak at " << trip.worst.theta_i * 180 / pi
              << ", " << trip.worst.theta_r * 180 / pi << ", " << trip.worst.phi * 180 / pi << " deg, 99 % "
              << trip.percentile_99 << ", median " << trip.median << ", " << trip.pairs << " pairs\n";
    INFO(what);
    CHECK(trip.worst.error <= worst);
    CHECK(trip.percentile_99 <= percentile_99);
}

struct TestSurface {
    const char* name;
    const char* index;
    double rms_roughness, correlation_length, albedo;
};
const std::vector<TestSurface> surfaces{{"aluminium", "Al", 0.28, 1.77, 0},
                                        {"ceramic", "Al2O3", 1.45, 13.2, 0.9},
                                        {"fine", "Al", 0.05, 1, 0},
                                        {"very rough", "Al", 2.5, 16, 0}};

/// One of them at tolerance 1e-6, far below what files hold.
spectral::Reflectance brdf_of(const TestSurface& surface, const spectral::WavelengthGrid& wavelengths) {
    return spectral::he_torrance_material(surface.name, {surface.rms_roughness, surface.correlation_length},
                                          spectral::built_in_optical_constants(surface.index),
                                          spectral::DiffuseAlbedo{surface.albedo})
        .at(wavelengths, {.tolerance = Tolerance{1e-6}});
}

/// All surfaces in the long version, the first otherwise.
std::vector<TestSurface> chosen() {
    return exhaustive() ? surfaces : std::vector<TestSurface>{surfaces.front()};
}

}  // namespace

TEST_CASE("a MERL file has its exact size and survives within 2 % of the peak") {
    for (const TestSurface& surface : chosen()) {
        const auto brdf = brdf_of(surface, rgb());
        const std::string bytes = merl_bytes(brdf);
        REQUIRE(bytes.size() == 34'992'012);
        check(std::string{"MERL, "}.append(surface.name), compared(brdf, merl_brdf(bytes, "m")), 0.02, 0.004);
        check(std::string{"MERL by bins, "}.append(surface.name),
              compared(brdf, merl_brdf(bytes, "m", rgb(), MerlLookup::bins)), 0.3, 0.08);
    }
}

TEST_CASE("MERL keeps colours and directions apart") {
    const spectral::Reflectance lobe = written(reciprocal_lobe, rgb());
    const std::string bytes = merl_bytes(lobe);
    // red first, then green and blue; the first bin is near the normal: f = (0.1 + 0.05 * 2) * 2.2 * 2
    const auto value = [&](std::size_t at) {
        double number = 0;
        std::memcpy(&number, bytes.data() + 12 + 8 * at, 8);
        return number;
    };
    CHECK(value(0) / 1500 == Approx(0.2 * 2.2 * 2).epsilon(1e-3));
    CHECK(value(1'458'000) * 1.15 / 1500 == Approx(0.15 * 2.2 * 2).epsilon(1e-3));
    CHECK(value(2 * 1'458'000) * 1.66 / 1500 == Approx(0.1 * 2.2 * 2).epsilon(1e-3));
    CHECK(value(1'457'999) < 0);  // both graze, far from the mirror direction
    check("MERL, reciprocal lobe", compared(lobe, merl_brdf(bytes, "m")), 2e-3, 1e-3);
    CHECK_THROWS_WITH(merl_bytes(written(grained_lobe, rgb())), Catch::Contains("azimuth"));
    CHECK_THROWS_WITH(merl_bytes(written(broad_lobe, one_wavelength)), Catch::Contains("3 in a MERL file"));
}

TEST_CASE("OpticStudio's tabular BSDF survives, a file per wavelength or an index of them") {
    for (const TestSurface& surface : chosen()) {
        const auto brdf = brdf_of(surface, one_wavelength);
        check(std::string{"Zemax, "}.append(surface.name),
              compared(brdf, zemax_brdf(zemax_texts(brdf).front(), "z")), 0.15, 0.04);
    }
    const spectral::Reflectance lobe = written(broad_lobe, rgb());
    const TemporaryFolder folder;
    write_zemax(lobe, folder.path() / "lobe.json");
    CHECK(std::filesystem::exists(folder.path() / "lobe_550nm.bsdf"));
    check("Zemax, broad lobe", compared(lobe, read_brdf(folder.path() / "lobe.json").brdf), 0.03, 5e-3);
    CHECK_THROWS_WITH(write_zemax(lobe, folder.path() / "lobe.bsdf"), Catch::Contains(".json"));
    CHECK_THROWS_WITH(zemax_texts(written(grained_lobe, one_wavelength)), Catch::Contains("azimuth"));
}

TEST_CASE("Zemax: angles count from the mirror direction, azimuth 0 towards the normal") {
    const spectral::Reflectance lobe = written(broad_lobe, one_wavelength);
    AngularGrid grid;
    grid.axis = PolarAxis::mirror;
    grid.theta_i = {30};
    grid.azimuth = {0, 180};
    grid.polar = {0, 30};
    const std::string text = zemax_texts(lobe, grid).front();
    const auto at = [&](double theta_r, double phi_r) {
        return broad_lobe(Direction::from_degrees(30, 0), Direction::from_degrees(theta_r, phi_r), 0);
    };
    Direction normal = Direction::from_degrees(0, 0);
    CHECK(at(0, 0) == broad_lobe(Direction::from_degrees(30, 0), normal, 0));
    const auto data = text.substr(text.find("TIS"));
    const auto lines = spectral::split(data, '\n');
    const auto number = [&](std::size_t line, std::size_t word) {
        return spectral::number_in(spectral::words(lines.at(line)).at(word));
    };
    CHECK(number(1, 0) == Approx(at(30, 180)).epsilon(1e-5));
    CHECK(number(1, 1) == Approx(at(0, 0)).epsilon(1e-5));
    CHECK(number(2, 1) == Approx(at(60, 180)).epsilon(1e-5));
}

TEST_CASE("Zemax: readers that interpolate between all nodes find the horizon's value at the horizon") {
    const auto lambert = [](const Direction&, const Direction&, std::size_t) { return 0.5 / pi; };
    const std::string text = zemax_texts(written(lambert, one_wavelength)).front();
    const auto data = text.substr(text.find("DataBegin"));
    for (const auto line : spectral::split(data, '\n')) {
        const auto words = spectral::words(line);
        if (words.size() < 2 || words.front() == "TIS") continue;
        for (const auto word : words) CHECK(spectral::number_in(word) == Approx(0.5 / pi).epsilon(1e-5));
    }
    // a file of others that holds nothing below the horizon is read without it
    AngularGrid grid = zemax_grid();
    const auto empty = values_on(grid, written(lambert, one_wavelength));
    CHECK(std::count(empty.begin(), empty.end(), 0.0) > 1000);
    const auto read = gridded_brdf("z", one_wavelength, grid, empty);
    for (const double theta : {10., 60., 85.}) {
        for (const double view : {80., 88., 89.9}) {
            double value = 0;
            read.brdf({Direction::from_degrees(theta, 0), Direction::from_degrees(view, 77)}, {&value, 1});
            CHECK(value == Approx(0.5 / pi));
        }
    }
}

TEST_CASE("a Zemax grid made for it holds a specular box of any size") {
    const auto plastic = hts::tables::testing::brdf_of("smooth-plastic.json", one_wavelength);
    for (const double solid_angle : {1e-5, 1e-3, 0.03}) {
        const auto boxed = with_specular_box(plastic, solid_angle);
        const auto read = zemax_brdf(zemax_texts(boxed, zemax_grid(solid_angle)).front(), "z");
        const RoundTrip trip = round_trip(boxed, read, {1000, 3, 0, solid_angle});
        for (const AlbedoError& each : trip.albedo) {
            if (each.theta_i < 1.4) CHECK(each.read_back == Approx(each.original).margin(0.01));
        }
    }
}

TEST_CASE("the reflectance TIS of a Zemax file is that of the surface") {
    const auto lambert = [](const Direction&, const Direction&, std::size_t) { return 0.5 / pi; };
    const std::string text = zemax_texts(written(lambert, one_wavelength)).front();
    const auto tis = text.find("TIS ");
    for (std::size_t at = tis; at != std::string::npos; at = text.find("TIS ", at + 1)) {
        const double value = spectral::number_in(text.substr(at + 4, text.find('\n', at) - at - 4));
        CHECK(value == Approx(0.5).epsilon(0.01));
    }
}

TEST_CASE("a tensor tree survives within its cells, isotropic or not") {
    for (const TestSurface& surface : chosen()) {
        const auto brdf = with_channels_named(brdf_of(surface, one_wavelength), luminance_wavelength());
        const std::string text = tensor_tree_xml(brdf, {exhaustive() ? 7 : 5, 0.02});
        std::cout << surface.name << ": " << text.size() << " bytes\n";
        // cells at the horizon span 10 degrees: see the bound
        check(std::string{"tensor tree, "}.append(surface.name), compared(brdf, radiance_brdf(text, "r")), 4,
              2);
    }
    for (const auto function : {broad_lobe, grained_lobe}) {
        const spectral::Reflectance lobe = written(function, luminance_wavelength());
        const std::string text = tensor_tree_xml(lobe, {5, 1e-3});
        CHECK((text.find("TensorTree4") != std::string::npos) == (function == grained_lobe));
        const Direction up = Direction::from_degrees(0, 0), aside = Direction::from_degrees(40, 30);
        double held = 0;
        radiance_brdf(text, "r").brdf({up, aside}, {&held, 1});
        CHECK(held == Approx(function(up, aside, 0)).epsilon(0.1));
        check("tensor tree, broad lobe", compared(lobe, radiance_brdf(text, "r")), 0.25, 0.2);
    }
}

TEST_CASE("a tensor tree takes Radiance's cell on an exact border") {
    // two halves of the incidence, bright below 30 degrees: (1 - sin 30)/2 is the border, which Radiance
    // gives to the flatter light
    const std::string dark = "{{0}{0}{0}{0}{0}{0}{0}{0}}", both = "{{1}{2}{1}{2}{1}{2}{1}{2}}";
    const std::string tree = "{" + both + dark + both + dark + both + dark + both + dark + "}";
    Tokens tokens{tree, "t"};
    const auto read = tensor_tree_brdf("t", luminance_wavelength(), 3, tokens);
    const Direction view = Direction::from_unit_vector({0.3, 0.4, std::sqrt(0.75)});
    const auto at = [&](double sine) {
        double value = 0;
        read.brdf({Direction::from_unit_vector({-sine, 0, std::sqrt(1 - sine * sine)}), view}, {&value, 1});
        return value;
    };
    CHECK(at(0.5 - 1e-5) == 2);
    CHECK(at(0.5 + 1e-5) == 1);
    CHECK(at(0.5) == 1);
    CHECK(at(0) == 2);  // along the normal, where the upper half of the dimension begins
}

TEST_CASE("Klems' patches: means survive within 5 % of the peak, and views and lights are told apart") {
    for (const auto& surface : chosen()) {
        const auto brdf = with_channels_named(brdf_of(surface, one_wavelength), luminance_wavelength());
        const KlemsBasis& basis = exhaustive() ? KlemsBasis::full() : KlemsBasis::quarter();
        const auto read = radiance_brdf(klems_xml(brdf, basis), "r");
        check(std::string{"Klems, point by point, "}.append(surface.name), compared(brdf, read), 3, 0.99);
        // means over patches by an even sequence of points (Roberts' R4), against the file
        constexpr std::array<double, 4> steps{0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                              0.5385972572236101};
        double worst = 0;
        for (std::size_t light = 0; light < basis.size(); light += 5) {
            double peak = 0;
            std::vector<double> means(basis.size()), held(basis.size());
            for (std::size_t view = 0; view < basis.size(); ++view) {
                const int count = exhaustive() ? 32768 : 4096;
                for (int i = 1; i <= count; ++i) {
                    const auto at = [&](std::size_t axis) {
                        return std::fmod(0.17 + i * steps[3 - axis], 1.0);
                    };
                    double value = 0;
                    brdf.brdf({basis.point(light, at(0), at(1)).mirror(), basis.point(view, at(2), at(3))},
                              {&value, 1});
                    means[view] += value / count;
                }
                read.brdf({basis.point(light, 0.5, 0.5).mirror(), basis.point(view, 0.5, 0.5)},
                          {&held[view], 1});
                peak = std::max(peak, means[view]);
            }
            for (std::size_t view = 0; view < basis.size(); ++view)
                worst = std::max(worst, std::abs(held[view] - means[view]) / peak);
        }
        std::cout << "Klems, patch by patch, " << surface.name << ": worst " << worst << " of peak\n";
        CHECK(worst <= 0.05);
    }
}

TEST_CASE("Klems' patches cover the hemisphere, and a direction is in the patch it comes from") {
    for (const KlemsBasis* basis : {&KlemsBasis::full(), &KlemsBasis::half(), &KlemsBasis::quarter()}) {
        CHECK(&KlemsBasis::named(basis->name()) == basis);
        double sum = 0;
        for (std::size_t patch = 0; patch < basis->size(); ++patch) {
            sum += basis->projected_solid_angle(patch);
            for (const double across : {0.01, 0.5, 0.99})
                for (const double along : {0.01, 0.5, 0.99})
                    CHECK(basis->patch(basis->point(patch, across, along)) == patch);
        }
        CHECK(sum == Approx(pi).epsilon(1e-12));
    }
    CHECK(KlemsBasis::full().size() == 145);
    CHECK(KlemsBasis::half().size() == 73);
    CHECK(KlemsBasis::quarter().size() == 41);
    // the mirror direction of a patch of light is the same patch of views
    const spectral::Reflectance lobe = written(broad_lobe, luminance_wavelength());
    const auto means = klems_means(lobe, KlemsBasis::full()).front();
    for (std::size_t light = 1; light < 145; ++light) {
        for (std::size_t view = 0; view < 145; ++view)
            CHECK(means[view * 145 + light] <= means[light * 145 + light] * 1.1);
    }
    CHECK_THROWS_WITH(KlemsBasis::named("LBNL/Klems Eighth"), Catch::Contains("Klems Quarter"));
}

TEST_CASE("CSV survives on its grid, also of surfaces with a grain, and scattered points by nearness") {
    for (const TestSurface& surface : chosen()) {
        const auto brdf = brdf_of(surface, one_wavelength);
        const auto points = points_of_csv(scatter_csv(brdf, csv_grid()), "c");
        const auto read = brdf_from("c", points);
        CHECK(read.layout == PointLayout::grid);
        check(std::string{"CSV, "}.append(surface.name), compared(brdf, read.brdf), 0.15, 0.04);
    }
    AngularGrid coarse = csv_grid(false);
    if (!exhaustive()) {
        coarse.theta_i = coarse.polar = {0, 20, 40, 60, 75, 89.9};
        coarse.azimuth = {0, 30, 60, 90, 120, 150, 180};
    }
    const spectral::Reflectance grained = written(grained_lobe, rgb());
    check("CSV, grained lobe",
          compared(grained, brdf_from("c", points_of_csv(scatter_csv(grained, coarse), "c")).brdf), 0.06,
          0.05);
    CHECK_THROWS_WITH(scatter_csv(grained, csv_grid()), Catch::Contains("azimuth"));

    Random random{4};
    ScatterPoints points{rgb(), {}, {}};
    const spectral::Reflectance lobe = written(reciprocal_lobe, rgb());
    std::vector<double> values(3);
    for (int i = 0; i < 3000; ++i) {
        const auto angles = [&] { return std::acos(random.uniform()) * 180 / pi; };
        const ScatterAngles at{angles(), 360 * random.uniform(), angles(), 360 * random.uniform()};
        lobe.brdf(
            {Direction::from_degrees(at.theta_i, at.phi_i), Direction::from_degrees(at.theta_r, at.phi_r)},
            values);
        points.angles.push_back(at);
        points.values.insert(points.values.end(), values.begin(), values.end());
    }
    const auto found = brdf_from("c", points);
    CHECK(found.layout == PointLayout::scattered);
    const auto& nearest = found.brdf;
    check("3000 scattered points, reciprocal lobe", compared(lobe, nearest), 0.2, 0.1);
    std::vector<double> there(3);
    for (std::size_t i = 0; i < 100; ++i) {  // and nearly exact at the points themselves
        const ScatterAngles& at = points.angles[i];
        nearest.brdf(
            {Direction::from_degrees(at.theta_i, at.phi_i), Direction::from_degrees(at.theta_r, at.phi_r)},
            there);
        CHECK(there[1] == Approx(points.values[3 * i + 1]).epsilon(1e-3));
    }
}

TEST_CASE("colours of a spectrum: a grey surface is grey, and each format says what it holds") {
    const auto visible = spectral::WavelengthGrid::linear(0.4, 0.7, 16);
    const auto grey =
        written([](const Direction&, const Direction&, std::size_t) { return 0.3 / pi; }, visible);
    const DirectionPair pair{Direction::from_degrees(10, 0), Direction::from_degrees(40, 50)};
    std::vector<double> values(3);
    linear_srgb_brdf(grey, spectral::Illuminant::D65).brdf(pair, values);
    for (const double value : values) CHECK(value == Approx(0.3 / pi).epsilon(1e-9));
    luminance_brdf(grey, spectral::Illuminant::E).brdf(pair, std::span{values}.first(1));
    CHECK(values[0] == Approx(0.3 / pi).epsilon(1e-9));
    const spectral::Reflectance lobe = written(broad_lobe, rgb());
    CHECK(brdf_at(lobe, 1).wavelengths().micrometres()[0] == 0.55);
    brdf_at(lobe, 2).brdf(pair, std::span{values}.first(1));
    CHECK(values[0] == broad_lobe(pair.in, pair.out, 2));
    CHECK_THROWS_AS(brdf_at(lobe, 3), Error);
}
