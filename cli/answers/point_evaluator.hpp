/// Evaluates the rows of a points file with the library, one pair of directions a row.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/answers/reflectance_cache.hpp"
#include "cli/answers/validity_warning.hpp"
#include "hts/terms.hpp"
#include "spectral/models/material.hpp"
#include "spectral/models/uncertainty.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {

using spectral::CsvReader;
using spectral::CsvRow;

/// The three terms at one pair and wavelength.
struct Evaluation {
    double wavelength;                             ///< [um]
    double cos_theta_i = 0, cos_theta_r = 0;       ///< of the pair
    double directional_diffuse = 0;                ///< [1/sr]
    double uniform_diffuse = 0;                    ///< [1/sr]
    double specular_reflectance = 0;               ///< [1]
    Mueller mueller{};                             ///< of the directional-diffuse term [1/sr]
    Mueller specular_mueller{};                    ///< of the specular term [1]
    double brdf_uncertainty = 0;                   ///< one standard deviation [1/sr]
    double specular_uncertainty = 0;               ///< the same [1]
    double btdf = 0;                               ///< where the view is behind the surface [1/sr]
    std::optional<spectral::LobeDetail> detail{};  ///< what the lobe of a rough surface was made of
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

/// Knows which column says what. A row's own n, k, rms_roughness_um, correlation_length_um (or
/// correlation_length_x_um, correlation_length_y_um and azimuth_deg) and albedo go before the material's;
/// they are those of rough surfaces.
class PointEvaluator {
  public:
    ///   points        its header is looked at here, its rows are not
    ///   material      may be missing if the rows say all but the albedo, which then is 0
    ///   wavelengths   every row at each of these; may be missing if the rows have a wavelength
    /// Throws UsageError or hts::Error if something is missing or said twice.
    PointEvaluator(const CsvReader& points, const std::optional<spectral::Material>& material,
                   std::optional<spectral::WavelengthGrid> wavelengths,
                   const spectral::EvaluationOptions& how);

    /// From now on rows are also told how uncertain they are. UsageError where rows say what the material is.
    void with(const spectral::UncertainMaterial& uncertain);

    /// Wavelengths per row.
    [[nodiscard]] std::size_t wavelengths() const noexcept { return wavelengths_ ? wavelengths_->size() : 1; }
    /// Whether it evaluates rough surfaces, of which there is detail.
    [[nodiscard]] bool of_rough_surfaces() const noexcept {
        return material_.properties().surface.has_value();
    }
    /// Columns that are in the header and mean nothing here; hts::Error for one that may
    /// be meant for a known one.
    [[nodiscard]] static std::vector<std::string> unused_columns(const CsvReader& points);

    /// What is asked of each row besides the terms.
    struct Wish {
        bool mueller = false, detail = false;
    };
    /// One row into `result` of wavelengths() places; hts::Error names quantity, value and legal range.
    ///   warning   is told the verdict on each
    void evaluate(const CsvRow& row, const Wish& wish, std::span<Evaluation> result,
                  ValidityWarning& warning) const;
    /// The same for a view behind the surface, btdf alone; hts::Error where the surface is opaque at a
    /// wavelength.
    void evaluate_transmission(const CsvRow& row, std::span<Evaluation> result) const;

  private:
    using Column = std::optional<std::size_t>;
    struct Columns {
        explicit Columns(const CsvReader& points, bool needs_wavelength);
        [[nodiscard]] bool any_of_material() const noexcept;
        PairColumns directions;
        std::optional<spectral::WavelengthColumn> wavelength;
        Column n, k, rms_roughness, correlation_length, correlation_length_x, correlation_length_y, azimuth,
            albedo;
    };

    void require_material(const CsvReader& points) const;
    void require_no_material_columns(const CsvReader& points) const;
    void require_whole_surfaces(const CsvReader& points) const;
    [[nodiscard]] spectral::RoughSurfaceValues own_values(const CsvRow& row) const;
    /// The row's own [um].
    [[nodiscard]] double wavelength(const CsvRow& row) const;
    /// What the row is of.
    ///   own   keeps it where no other row shares it
    [[nodiscard]] const spectral::Reflectance& reflectance(const CsvRow& row,
                                                           std::optional<spectral::Reflectance>& own) const;
    void add_uncertainty(const DirectionPair& pair, const spectral::WavelengthGrid& grid,
                         std::span<Evaluation> result) const;

    Columns columns_;
    spectral::Material material_;
    std::optional<spectral::WavelengthGrid> wavelengths_;
    spectral::EvaluationOptions how_;
    std::optional<spectral::Reflectance> same_for_all_;  ///< rows, if it is
    std::shared_ptr<WavelengthCache<spectral::Reflectance>>
        by_wavelength_;                                ///< of rows that differ in nothing else
    std::shared_ptr<CompensationCache> compensation_;  ///< null without
    std::optional<spectral::UncertainMaterial> uncertain_{};
    std::shared_ptr<WavelengthCache<spectral::UncertainReflectance>> uncertainty_;  ///< by wavelength
};

}  // namespace hts::cli
