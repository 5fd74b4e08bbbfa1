/// Standard deviations of the numbers in a material file, and those of what it reflects that follow.
///
///     const UncertainMaterial aluminium{read_text_file(path), path};
///     std::vector<double> deviations(grid.size());
///     aluminium.at(grid).brdf({in, out}, deviations);                                            // 1/sr
///
/// The file states them beside what they belong to, by the names of its keys:
///
///     {"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al",
///      "uncertainty": {"rms_roughness_um": 0.01, "correlation_length_um": 0.06, "n": 0.02,
///                      "correlated": [["rms_roughness_um", "correlation_length_um", 0.8]]}}
///
/// A name may be any number of the file, inner keys and places in lists behind "/": "correlation/B_um",
/// "correlation_length_um/0", "lobes/0/mx". "n" and "k" are the index, whatever gives it: one deviation at
/// all wavelengths, which err together.
///
///   variance   sum over i, j of d_i d_j r_ij s_i s_j, s the standard deviations, r their correlations, d the
///              derivatives; of first order, so the deviations must be small beside what the value bends on
///   d          of "he" with a Gaussian correlation, without films and "rms_band_um": exactly
///              (hts/he_torrance_gradient.hpp). Of all other models: the difference between a quarter of a
///              standard deviation above and as much below, or to one side at the end of the legal range
///
/// A tabulated power spectrum has its errors in its table, row by row (column psd_um4_error): they are
/// independent, and nothing else need be uncertain. Of more than 48 rows those within a 32nd of the range of
/// ln f are changed together.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "spectral/models/material.hpp"

namespace hts::spectral {

struct SpectrumErrors;

struct UncertainNumber {
    std::string name;
    double standard_deviation;  ///< > 0, in the unit of the number
};

/// What a material reflects at some wavelengths, as uncertain as its numbers are. Any thread may ask.
class UncertainReflectance {
  public:
    /// How one number changes what is reflected, a standard deviation at a time.
    class Change {
      public:
        virtual ~Change() = default;
        virtual void brdf(const DirectionPair& pair, std::span<double> values) const = 0;
        virtual void specular_reflectance(const Direction& in, std::span<double> values) const = 0;
    };

    ///   correlations   row by row
    UncertainReflectance(std::vector<std::shared_ptr<const Change>> changes, std::vector<double> correlations)
        : changes_{std::move(changes)}, correlations_{std::move(correlations)} {}

    /// One standard deviation of all diffuse terms [1/sr], a value per wavelength.
    void brdf(const DirectionPair& pair, std::span<double> deviations) const;
    /// The same of the specular reflectance [1].
    void specular_reflectance(const Direction& in, std::span<double> deviations) const;

  private:
    template <class Ask>
    void combine(std::span<double> deviations, const Ask& ask) const;

    std::vector<std::shared_ptr<const Change>> changes_;
    std::vector<double> correlations_;
};

/// A material file with what it says of its errors.
class UncertainMaterial {
  public:
    ///   text     of the file that stood at `path`
    ///   given    standard deviations that go before the file's; uncorrelated
    /// hts::Error that names key and legal range: where nothing is uncertain, a name is no number of the
    /// file, a deviation is not > 0 and finite, or correlations are such as no errors have.
    UncertainMaterial(const std::string& text, std::filesystem::path path,
                      const std::vector<UncertainNumber>& given = {},
                      const std::vector<ModelEntry>& models = built_in_models());

    /// Those of a tabulated spectrum last: relative.
    [[nodiscard]] const std::vector<UncertainNumber>& numbers() const noexcept { return numbers_; }
    /// Between all numbers, row by row.
    [[nodiscard]] const std::vector<double>& correlations() const noexcept { return correlations_; }
    /// The material with other values of its numbers.
    ///   differences   from what the file says, one per number
    [[nodiscard]] Material with(std::span<const double> differences) const;

    /// hts::Error as Material::at, and where a number cannot move within its legal range.
    ///   options   tolerance and policy; differences are taken of values that are exact to 1e-9 at least
    [[nodiscard]] UncertainReflectance at(const WavelengthGrid& wavelengths,
                                          const EvaluationOptions& options = {}) const;

  private:
    [[nodiscard]] bool has_exact_derivatives(const Reflectance& reflectance) const;

    std::string text_;
    std::filesystem::path path_;
    std::vector<ModelEntry> models_;
    Material material_;
    std::vector<UncertainNumber> numbers_;
    // JSON pointers into the text, of the first numbers; of "n" and "k" empty where the file has no such
    // number. The last numbers are those of the spectrum.
    std::vector<std::string> pointers_;
    std::shared_ptr<const SpectrumErrors> spectrum_;
    std::vector<double> correlations_;
};

}  // namespace hts::spectral
