#include <limits>

#include "hts/microfacet/ashikhmin.hpp"
#include "spectral/materials/coated_constants.hpp"
#include "spectral/models/model_readers.hpp"
#include "spectral/text/png.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

/// A number, or "infinity".
double width_from(const JsonValue& width) {
    if (!width.is_text()) return width.number();
    if (width.text() != "infinity") throw width.error(R"(must be a number or "infinity")");
    return std::numeric_limits<double>::infinity();
}

/// A density made from two numbers; each is tried alone first, so that a message names one key.
NormalDensity density_of(const JsonValue& first, double a, double legal_a, const JsonValue& second, double b,
                         NormalDensity (*of)(double, double)) {
    located(first.place(), [&] { return of(a, 1); });
    located(second.place(), [&] { return of(legal_a, b); });
    return of(a, b);
}

NormalDensity gaussian_from(const JsonValue& normals) {
    normals.require_keys_among({"type", "sigma_x", "sigma_y"});
    const JsonValue x = normals["sigma_x"], y = normals["sigma_y"];
    return density_of(x, width_from(x), 1, y, width_from(y), NormalDensity::gaussian);
}

NormalDensity grooves_from(const JsonValue& normals) {
    normals.require_keys_among({"type", "slope_deg", "sigma"});
    const JsonValue slope = normals["slope_deg"], sigma = normals["sigma"];
    return density_of(slope, slope.number() * degree, 0, sigma, width_from(sigma), NormalDensity::grooves);
}

NormalDensity velvet_from(const JsonValue& normals) {
    normals.require_keys_among({"type", "sigma"});
    const JsonValue sigma = normals["sigma"];
    const double width = width_from(sigma);
    return located(sigma.place(), [&] { return NormalDensity::inverse_gaussian(width); });
}

NormalDensity slanted_from(const JsonValue& normals) {
    normals.require_keys_among({"type", "slant_deg", "sigma"});
    const JsonValue slant = normals["slant_deg"], sigma = normals["sigma"];
    return density_of(slant, slant.number() * degree, 0, sigma, width_from(sigma),
                      [](double angle, double width) { return NormalDensity::slanted_fibres(width, angle); });
}

/// Rows of numbers of equal length, [[…], …].
ValueGrid grid_from(const JsonValue& rows) {
    ValueGrid grid{0, 0, {}};
    for (const JsonValue& row : rows.items()) {
        const auto values = row.items();
        if (grid.rows == 0) grid.columns = values.size();
        if (values.size() != grid.columns) throw row.error("must be as long as the first row");
        for (const JsonValue& value : values) grid.values.push_back(value.number());
        ++grid.rows;
    }
    return grid;
}

NormalDensity tabulated_from(const JsonValue& normals) {
    normals.require_keys_among({"type", "rows"});
    const JsonValue rows = normals["rows"];
    const ValueGrid grid = grid_from(rows);
    return located(rows.place(), [&] { return NormalDensity::tabulated(grid); });
}

/// A picture, bright where normals are many, over a Gaussian.
NormalDensity image_from(const JsonValue& normals, const std::filesystem::path& folder) {
    normals.require_keys_among({"type", "file", "extent", "sigma_x", "sigma_y"});
    const JsonValue file = normals["file"], extent = normals["extent"];
    const JsonValue x = normals["sigma_x"], y = normals["sigma_y"];
    const double sigma_x = width_from(x), sigma_y = width_from(y), edge = extent.number();
    static_cast<void>(density_of(x, sigma_x, 1, y, sigma_y, NormalDensity::gaussian));  // names a wrong width
    const ValueGrid pixels = located(file.place(), [&] { return read_png_luminance(folder / file.text()); });
    return located(extent.place(), [&] { return NormalDensity::image(sigma_x, sigma_y, pixels, edge); });
}

NormalDensity normals_from(const JsonValue& normals, const std::filesystem::path& folder);

/// [[share, {…}], …]
// NOLINTNEXTLINE(misc-no-recursion): mixtures nest
NormalDensity mixture_from(const JsonValue& normals, const std::filesystem::path& folder) {
    normals.require_keys_among({"type", "of"});
    const JsonValue list = normals["of"];
    std::vector<NormalDensity::Share> shares;
    for (const JsonValue& row : list.items()) {
        const auto pair = row.items();
        if (pair.size() != 2) throw row.error("must be a share and normals, [0.7, {…}]");
        const double share = pair[0].number();
        const NormalDensity density = normals_from(pair[1], folder);
        shares.push_back({share, density});
        located(pair[0].place(), [&] { return NormalDensity::mixture({shares.back()}); });
    }
    return located(list.place(), [&] { return NormalDensity::mixture(shares); });
}

// NOLINTNEXTLINE(misc-no-recursion): mixtures nest
NormalDensity normals_from(const JsonValue& normals, const std::filesystem::path& folder) {
    const JsonValue type = normals["type"];
    if (type.text() == "gaussian") return gaussian_from(normals);
    if (type.text() == "grooves") return grooves_from(normals);
    if (type.text() == "inverse_gaussian") return velvet_from(normals);
    if (type.text() == "slanted_fibres") return slanted_from(normals);
    if (type.text() == "tabulated") return tabulated_from(normals);
    if (type.text() == "image") return image_from(normals, folder);
    if (type.text() == "mixture") return mixture_from(normals, folder);
    throw type.error(
        in_quotes(type.text()) +
        " is not known; must be gaussian, grooves, inverse_gaussian, slanted_fibres, tabulated, image "
        "or mixture");
}

double checked_f0(double f0) {
    return FacetFresnel::schlick(f0).at_normal();
}

/// Facets of the reflectance "f0", by Schlick, or of the index "index", exactly.
Material material_from(const MaterialFile& file, const AshikhminFacets& facets,
                       std::vector<std::string> warnings) {
    const bool metal = truth_or(file.json, "metal", false);
    const SpectralNumber albedo{file.json, "diffuse_albedo", 0, [&](double a) {
                                    static_cast<void>(AshikhminBrdf{facets, FacetFresnel::schlick(0), a});
                                    return a;
                                }};
    if (metal && file.json.find("diffuse_albedo")) {
        throw file.json["diffuse_albedo"].error("must not come with metal, whose diffuse light is its f0's");
    }
    if (const auto index = file.json.find("index")) {
        if (metal || file.json.find("f0")) throw index->error("must not come with f0 or metal");
        const CoatedConstants constants = coated_constants_from(file.json, file.folder);
        for (const std::string& warning : constants.warnings()) warnings.push_back(warning);
        return material_of(
            [=](const Wavelength& wavelength, OutsideRange policy) {
                return AshikhminBrdf{facets, FacetFresnel::exact(constants.index(wavelength, policy)),
                                     albedo(wavelength, policy)};
            },
            std::move(warnings));
    }
    if (const auto films = file.json.find("films")) throw films->error("must come with index, not with f0");
    const SpectralNumber f0{file.json["f0"], checked_f0};
    return material_of(
        [=](const Wavelength& wavelength, OutsideRange policy) {
            const double reflectance = f0(wavelength, policy);
            if (metal) return AshikhminBrdf::metal(facets, reflectance);
            return AshikhminBrdf{facets, FacetFresnel::schlick(reflectance), albedo(wavelength, policy)};
        },
        std::move(warnings));
}

}  // namespace

Material read_ashikhmin(const MaterialFile& file) {
    file.json.require_keys_among({"name", "model", "normals", "f0", "index", "films", "metal",
                                  "diffuse_albedo", "correlated_shadowing"});
    const NormalDensity density = normals_from(file.json["normals"], file.folder);
    const bool correlated = truth_or(file.json, "correlated_shadowing", false);
    const AshikhminFacets facets{density,
                                 correlated ? FacetShadowing::correlated : FacetShadowing::uncorrelated};
    std::vector<std::string> warnings;
    if (const auto tilted = density.tilted_mean()) warnings.push_back(tilted->text());
    return material_from(file, facets, std::move(warnings));
}

}  // namespace hts::spectral
