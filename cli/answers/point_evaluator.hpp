/// Evaluates the rows of a points file with the library, one pair of directions a row.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "cli/answers/validity_warning.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/models/any_reflector.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {

using spectral::CsvReader;
using spectral::CsvRow;

/// The three terms at one pair and wavelength, and what the directional-diffuse term of He-Torrance was made of.
struct Evaluation {
    double wavelength;  ///< [um]
    DirectionalDiffuse directional;
    double uniform_diffuse;       ///< [1/sr]
    double specular_reflectance;  ///< [1]
    double effective_roughness;   ///< [um]
    double shadowing;             ///< S
    Mueller mueller;              ///< of the directional-diffuse term [1/sr]
    double btdf;                  ///< where the view is behind the surface [1/sr]
};

/// The columns of a pair of directions.
class PairColumns {
  public:
    /// hts::Error if one of the four is missing.
    explicit PairColumns(const CsvReader& points);
    /// The pair of a row; hts::Error names column, value and legal range.
    [[nodiscard]] DirectionPair pair(const CsvRow& row) const;

  private:
    std::size_t theta_i_, phi_i_, theta_r_, phi_r_;
};

/// The energy compensation of surfaces and wavelengths, each solved once. Any thread may ask.
class CompensationCache {
  public:
    [[nodiscard]] const spectral::EnergyCompensation& at(const Surface& surface,
                                                         const Wavelength& wavelength);

  private:
    struct Entry {
        std::once_flag once;
        std::optional<spectral::EnergyCompensation> solved;
    };
    std::mutex mutex_;
    std::map<std::array<double, 3>, Entry> entries_;
};

/// Knows which column says what. A row's own n, k, rms_roughness_um, correlation_length_um and albedo go
/// before the material's; they are the He-Torrance model's alone.
class PointEvaluator {
  public:
    ///   points        its header is looked at here, its rows are not
    ///   reflector     may be missing if the rows say all but the albedo, which then is 0
    ///   wavelengths   every row at each of these; may be missing if the rows have a wavelength
    ///   compensate_energy   as spectral/energy/compensation.hpp says; of model he
    /// Throws UsageError or hts::Error if something is missing or said twice.
    PointEvaluator(const CsvReader& points, const std::optional<spectral::AnyReflector>& reflector,
                   std::optional<spectral::WavelengthGrid> wavelengths, spectral::OutsideRange policy,
                   bool compensate_energy = false);

    /// Wavelengths per row.
    [[nodiscard]] std::size_t wavelengths() const noexcept { return wavelengths_ ? wavelengths_->size() : 1; }
    /// Columns that are in the header and mean nothing here.
    [[nodiscard]] static std::vector<std::string> unused_columns(const CsvReader& points);

    /// One row into `result` of wavelengths() places; hts::Error names quantity, value and legal range.
    ///   warning   is told the verdict on each
    void evaluate(const CsvRow& row, bool with_mueller, std::span<Evaluation> result,
                  ValidityWarning& warning) const;
    /// The same for a view behind the surface, btdf alone; hts::Error where the surface is opaque at a wavelength.
    void evaluate_transmission(const CsvRow& row, std::span<Evaluation> result) const;

  private:
    using Column = std::optional<std::size_t>;
    struct Columns {
        explicit Columns(const CsvReader& points, bool needs_wavelength);
        PairColumns directions;
        Column wavelength, n, k, rms_roughness, correlation_length, albedo;
    };
    /// What is the same for all rows at one wavelength, or what one row says.
    using Sample = SpectralSample;

    void require_material(const CsvReader& points) const;
    void require_no_material_columns(const CsvReader& points) const;
    void evaluate_other(const CsvRow& row, const spectral::DirectionPair& pair,
                        std::span<Evaluation> result) const;
    [[nodiscard]] bool same_for_all_rows() const noexcept;
    [[nodiscard]] Surface surface(const CsvRow& row) const;
    [[nodiscard]] Sample sample(const CsvRow* row, const Wavelength& wavelength) const;
    [[nodiscard]] RefractiveIndex index(const CsvRow* row, const Wavelength& wavelength) const;
    [[nodiscard]] double albedo(const CsvRow* row, const Wavelength& wavelength) const;
    [[nodiscard]] Wavelength wavelength(const CsvRow& row, std::size_t i) const;
    /// Of a model other than He-Torrance.
    [[nodiscard]] spectral::AnyModel model(const Wavelength& wavelength, std::size_t i) const;

    Columns columns_;
    std::optional<spectral::Reflector> reflector_;
    std::optional<spectral::AnyReflector> other_;  // of a model other than He-Torrance
    std::optional<spectral::WavelengthGrid> wavelengths_;
    spectral::OutsideRange policy_;
    std::shared_ptr<CompensationCache> compensation_;  // null without
    std::vector<spectral::EnergyCompensation>
        compensations_;            // one per wavelength if these and the surface are the same
    std::vector<Sample> samples_;  // one per wavelength if the same for all rows, else none
    std::optional<spectral::AnySpectrum> spectrum_;  // the same of another model
};

}  // namespace hts::cli
