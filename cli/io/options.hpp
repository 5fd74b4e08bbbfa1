/// Options that several verbs share, and their way from degrees and text to the library's types.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hts/polarisation.hpp"
#include "hts/tolerance.hpp"
#include "spectral/models/material.hpp"

namespace hts::cli {

/// --theta-i, --theta-r and the azimuths: --phi between the two, or --phi-i and --phi-r [deg].
struct DirectionOptions {
    std::optional<double> theta_i, theta_r, phi, phi_i, phi_r;

    void add_to(CLI::App& verb);
    /// Whether any of them was given.
    [[nodiscard]] bool any() const noexcept;
    /// The first option that is lacking, "" if none is.
    [[nodiscard]] std::string missing() const;
    [[nodiscard]] double incident_azimuth() const noexcept { return phi_i.value_or(0); }
    [[nodiscard]] double reflected_azimuth() const noexcept { return phi ? *phi : phi_r.value_or(0); }
    /// Throws UsageError if an option is missing or an angle out of range.
    [[nodiscard]] spectral::DirectionPair pair() const;
};

/// The files that are written beside PATH.
using Beside = std::vector<std::string> (*)(const std::string& path);

/// --output and --json.
struct OutputOptions {
    std::string path = "-";
    bool json = false;

    void add_to(CLI::App& verb, Beside beside = nullptr);
};

/// --outside error, hold or zero, and --clamp, which is --outside hold.
struct OutsideOption {
    spectral::OutsideRange policy = spectral::OutsideRange::error;

    void add_to(CLI::App& verb);
};

/// --material and --outside.
struct MaterialOptions {
    std::string path;
    OutsideOption outside{};

    /// The option of the file, for `required()`.
    CLI::Option* add_to(CLI::App& verb);
    /// The file's text, read once, so that it may be standard input.
    [[nodiscard]] const std::string& text() const;
    /// The material; what it warns of goes to standard error.
    [[nodiscard]] spectral::Material read() const;
    [[nodiscard]] spectral::OutsideRange policy() const noexcept { return outside.policy; }
    /// Evaluation as exact as it can be, by this policy outside the material's range.
    [[nodiscard]] spectral::EvaluationOptions evaluation() const {
        return {.tolerance = Tolerance{hts::accuracy::finest_tolerance}, .outside = policy()};
    }

    mutable std::optional<std::string> known_text{};  ///< once it was read
};

/// Says on standard error that a material reflects more than falls in, where it does by more than 0.5 %.
void warn_of_gain(const std::string& source, double reflectance);

/// UsageError that names `option` where it asks for what only rough surfaces, or only polarised models, can.
void require_rough_surface(const spectral::Material& material, const std::string& option);
void require_polarised(const spectral::Material& material, const std::string& option);

/// --tolerance of what is evaluated.
struct ToleranceOption {
    std::optional<double> value{};

    void add_to(CLI::App& verb);
    /// The finest where it was not given.
    [[nodiscard]] Tolerance tolerance() const;
    /// UsageError where one was given that the material cannot meet.
    void require_met_by(const spectral::Material& material) const;
};

/// "name=value", the value a number; UsageError that names the option otherwise.
[[nodiscard]] std::pair<std::string, double> assignment(const std::string& option, const std::string& text);

/// "s", "p", "unpolarised" or "s0,s1,s2,s3"; UsageError otherwise.
[[nodiscard]] Stokes stokes_from_option(const std::string& text);

/// For `check`: a whole number, a number from `first` to `last`. What is neither (-1, 1.5, nan) is wrong
/// usage, with the range in the message.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t first, std::uint64_t last);
[[nodiscard]] CLI::Validator number_within(double first, double last);
/// For `check` of seeds: any whole number of 64 bits.
[[nodiscard]] CLI::Validator seed_number();
/// Only one of the names is taken; the nearest is said for others.
CLI::Option* one_of(CLI::Option* option, std::vector<std::string> names);
/// Names that shells complete to, beside files.
CLI::Option* offers(CLI::Option* option, std::vector<std::string> names);
/// What those two were given; none for other options.
[[nodiscard]] const std::vector<std::string>& choices_of(const CLI::Option* option);

/// A list with commas between its values, of one word or several.
CLI::Option* comma_list(CLI::App& verb, const std::string& names, std::vector<double>& values,
                        const std::string& description);
CLI::Option* comma_list(CLI::App& verb, const std::string& names, std::vector<std::string>& values,
                        const std::string& description);

/// --columns: of which columns an answer has more; each must be one of `known`, once.
CLI::Option* more_columns(CLI::App& verb, std::vector<std::string>& columns, std::vector<std::string> known,
                          const std::string& description);

// One interface for all verbs: the first name is the one in the help text, the others are taken, too.

inline constexpr auto material_names = "material,--material,-m";
inline constexpr auto theta_i_names = "--theta-i,--theta";
inline constexpr auto wavelength_names = "--wavelength,--wavelengths";
inline constexpr auto wavelengths_names = "--wavelengths,--wavelength";
/// How many pairs, samples or draws.
inline constexpr auto count_names = "--count,--samples,--pairs";
inline constexpr auto samples_names = "--samples,--pairs,--count";
inline constexpr auto pairs_names = "--pairs,--samples,--count";

// What the files of an option are to the run. The rule for all of them, spectral::RunFiles::check, is looked
// at before any verb begins.

/// Files that are read.
CLI::Option* reads(CLI::Option* option);
/// The same of a file that is read as a whole; "-" is standard input.
CLI::Option* reads_whole(CLI::Option* option);
/// A file that is written, and others beside it.
CLI::Option* writes(CLI::Option* option, Beside beside = nullptr);
/// A picture PATH.svg, with its script PATH.gnuplot.
CLI::Option* draws(CLI::Option* option);
/// A folder that is filled, made where it is not there, and names of files that it gets.
CLI::Option* fills(CLI::Option* option, const std::vector<std::string>& names = {});

/// UsageError that names the option if a polar angle is not 0 ... 90 degrees.
void require_angles(const std::string& option, const std::vector<double>& degrees);

/// A material at wavelengths that an option gave; hts::Error that names the option if the material is not
/// known there.
[[nodiscard]] spectral::Reflectance reflectance_from_option(const std::string& option,
                                                            const spectral::Material& material,
                                                            const spectral::WavelengthGrid& wavelengths,
                                                            const spectral::EvaluationOptions& how);

/// What an option of a material's value says as JSON: a bare word is text, anything else JSON already.
[[nodiscard]] std::string json_of(const std::string& text);

/// A wavelength, or a grid in the form of WavelengthGrid::parse; UsageError otherwise.
Wavelength wavelength_from_option(double um);
[[nodiscard]] spectral::WavelengthGrid wavelengths_from_option(const std::string& text);

}  // namespace hts::cli
