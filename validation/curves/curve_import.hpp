/// Reads other people's files of scattered light into curve sets.
///
///   csv         a header line with named columns; angles carry their unit in the name, "theta_i_deg" or
///               "…_rad"
///   fred        FRED's scatter table: "type bsdf_data", "format angles=deg bsdf=value scale=1", a line
///               "theta_i phi_i" before the lines "theta_s phi_s bsdf" it lights
///   astm        ASTM E1392: lines "KEY value", the last "VARS theta_i,phi_i,theta_s,phi_s,…", then one line
///               per point, in radians; channels named "450nm" carry their wavelength
///   digitised   pixels read off a printed figure, with the calibration of its axes (JSON, see
///               validation/curves/digitised.hpp)
///
/// None of them says all that a curve set must; the rest is a recipe, a JSON file described in
/// validation/curves/data/README.md. Numbers are never changed: an import selects, converts units and
/// conventions, and says so.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/curves/curve.hpp"

namespace hts::validation {

enum class ImportFormat { csv, fred, astm, digitised };

/// Where values stand and at what wavelengths they were taken.
struct ValueColumn {
    std::string column;          ///< of the CSV file, or the channel of the ASTM file; empty for the others
    std::optional<Band> band{};  ///< none where the file says it
    /// Column of one standard deviation of each value, in its unit (csv); empty: there is none.
    std::string uncertainty{};
};

/// Which points are kept. What is left out is counted in a note.
struct Selection {
    double least_theta = 0, largest_theta = 90;  ///< of both polar angles [deg]
    double least_apart = 0;        ///< of light and viewer, whose heads else hide each other [deg]
    double least_from_mirror = 0;  ///< of viewer and mirror direction, where spikes are not resolved [deg]
    bool positive_only = false;    ///< leaves values <= 0 out, which biases what is noise about 0
    bool in_plane_only = false;
    std::vector<double> only_theta_i{};  ///< these alone [deg]; empty: all
    int every =
        1;  ///< of the points left, per curve: the first and each so-manieth after it, and the largest
    double all_within = 0;  ///< of the mirror direction nothing is thinned out [deg]
};

struct ImportRecipe {
    ImportFormat format = ImportFormat::csv;
    CurveSet head;  ///< everything but curves and uncertainty
    Sweep sweep = Sweep::outgoing;
    std::map<std::string, std::string>
        angle_columns{};  ///< csv: "theta_i", "phi_i", "theta_r", "phi_r" -> column
    std::vector<ValueColumn> values{};
    /// Sign of an in-plane angle on the mirror's side, 1 or -1; azimuth of the mirror direction as the file
    /// counts [deg], where the light stands at 0: 180 or 0.
    double mirror_sign = 1, mirror_azimuth = 180;
    Selection selection{};
    bool emissivity = false;  ///< values are emissivities: 1 less them is what the set holds
    /// csv: only the rows whose column "row_column" holds this text; empty: all.
    std::string row_column{}, row_text{};
    /// The smallest step of the printed values, step / sqrt 12 of which is the standard deviation of
    /// rounding. It adds to other uncertainties; alone it says nothing of the noise, and none are written.
    double resolution = 0;
    double relative_uncertainty = 0;  ///< of every value, one standard deviation, where the user knows it
    /// Whether pairs that swap light and viewer tell how far the values can be trusted.
    bool uncertainty_from_reciprocity = false;
};

/// Reads a recipe; hts::Error "path: key "…": …" that names the legal range.
///   surface   what the file shows, in place of the recipe's key "surface"; empty: the key must be there
[[nodiscard]] ImportRecipe read_recipe(const std::filesystem::path& path, const std::string& surface = "");

/// Reads a file as the recipe says. hts::Error "path:line: …" for what is no number, missing columns, angles
/// outside 0 … 90 deg, directions that stand twice, and negative values too large for noise: noise about 0 is
/// kept, and its standard deviation becomes CurveSet::noise_floor where the recipe states none.
///   how   the command, for CurveSet::how
[[nodiscard]] CurveSet imported_curves(const std::filesystem::path& path, const ImportRecipe& recipe,
                                       const std::string& how);

}  // namespace hts::validation
