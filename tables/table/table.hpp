/// Lookup tables of a reflectance with a promised error: exact values once, then a few loads each time.
///
///     const hts::tables::Table table = hts::tables::Table::open("aluminium.htst");
///     std::vector<double> spectrum(table.wavelengths().size());
///     table.brdf({in, out}, spectrum);  // allocates nothing
///
/// What is promised. At the tabulated wavelengths and polar angles up to 88 deg, for the
/// directional-diffuse term f,
///   |f of the table - f exact| / (f exact + 1e-3 peak) <= tolerance,
/// peak the largest f of that theta_i and wavelength. It was measured on random directions when the table was
/// built, and `table_error` measures it again. The specular and the hemispherical reflectance keep the same
/// tolerance with 1 as peak. At other wavelengths a table says nothing; nearer to the horizon it
/// gives the lobe of 88 deg.
///
/// How. ln(f + floor) is a cubic spline in the coordinates of table_coordinates.hpp, with a floor 1e-12 below
/// the peaks so that it stays finite. Its values are the components of a spectrum in a basis of few spectra,
/// chosen for each table; those of a node lie side by side. `hts table chart` compares it with other ways.
/// Surfaces must be isotropic and reciprocal. Polarisation is that of facets: a ratio F_p/F_s over theta_d.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <span>
#include <string>

#include "spectral/materials/piecewise_linear.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// The promise ends here [rad].
inline constexpr double steepest_theta = 88 * std::numbers::pi / 180;

/// How the axes are spaced; see table_coordinates.hpp.
struct TableSpacing {
    double grazing = 4;  ///< the more, the denser towards the normal, 0.1 ... 100
    double turn = 3;     ///< the more, the denser towards the mirror plane, 0.1 ... 100

    friend bool operator==(const TableSpacing&, const TableSpacing&) = default;
};

/// Errors |table - exact| / (exact + 1e-3 peak) over random pairs and all wavelengths.
struct TableError {
    double median = 0, percentile_99 = 0, largest = 0;
    std::uint64_t pairs = 0;  ///< half of them drawn around the lobe
    std::uint64_t seed = 0;

    friend bool operator==(const TableError&, const TableError&) = default;
};

/// Number of nodes along each axis.
struct TableNodes {
    std::size_t grazing = 0, ratio = 0,
                turn = 0;                  ///< of the directional-diffuse term, as in table_coordinates.hpp
    std::size_t specular = 0, albedo = 0;  ///< over grazing
    std::size_t polarisation = 0;          ///< over cos theta_d; 0 where the table is not polarised

    friend bool operator==(const TableNodes&, const TableNodes&) = default;
};

/// What a table is of.
struct TableSource {
    std::string name;           ///< of the surface
    std::string material;       ///< text of its material file; "" for what came from elsewhere
    std::string material_path;  ///< where that text stood; relative paths in it begin there
    spectral::OutsideRange policy = spectral::OutsideRange::error;

    friend bool operator==(const TableSource&, const TableSource&) = default;
};

/// What stands in the header of a table.
struct TableInfo {
    TableSource source;
    spectral::WavelengthGrid wavelengths;
    double tolerance;  ///< promised
    TableError error;  ///< measured when it was built
    TableSpacing spacing;
    TableNodes nodes;
    std::size_t components;       ///< spectra that the lobe is a sum of, 1 ... 256
    bool double_precision;        ///< of the directional-diffuse term: 8 bytes a value instead of 4
    std::string library_version;  ///< that built it
};

struct TableContents;

/// An immutable table; copies share it. Lookups are total, allocate nothing and may run on any thread.
class Table final : public spectral::Evaluator {
  public:
    /// Maps a file into memory and checks all of it. hts::Error "path: …" where it is no table, of another
    /// version or byte order, cut short, changed, or not what its header says.
    ///   cost   a pass over the file, some 0.4 GB/s
    [[nodiscard]] static Table open(const std::filesystem::path& path);
    /// From the bytes of a file.
    ///   name   in messages
    [[nodiscard]] static Table from_bytes(std::string bytes, const std::string& name);

    [[nodiscard]] const TableInfo& info() const noexcept;
    [[nodiscard]] spectral::Reflectance reflectance() const {
        return spectral::Reflectance{std::make_shared<const Table>(*this)};
    }
    /// Bytes of the file.
    [[nodiscard]] std::size_t bytes() const noexcept override;
    /// CRC-64/XZ of the file but for the eight bytes that hold it, 16 hexadecimal digits.
    [[nodiscard]] std::string checksum() const;
    /// Whether the promise holds for a pair: both polar angles up to 88 deg.
    [[nodiscard]] static bool covers(const DirectionPair& pair) noexcept;

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override;
    /// The same for many pairs, all wavelengths of a pair together, on the calling thread.
    ///   values   pairs.size() * wavelengths().size()
    void brdf(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept;
    void uniform_diffuse(std::span<double> values) const noexcept override;
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override;
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override;
    /// Directional-hemispherical reflectance of both diffuse terms [1], one value per wavelength.
    void diffuse_albedo(const Direction& in, std::span<double> values) const noexcept;
    [[nodiscard]] spectral::Properties properties() const override;
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override;
    void directional_diffuse_mueller(const DirectionPair& pair,
                                     std::span<Mueller> values) const noexcept override;

  private:
    explicit Table(std::shared_ptr<const TableContents> contents);
    std::shared_ptr<const TableContents> contents_;
};

/// A table as spectral::read_plan wants it; hts::Error as of Table::open, or if its checksum is another.
[[nodiscard]] spectral::Reflectance open_for_plan(const std::filesystem::path& path,
                                                  const std::string& checksum);

}  // namespace hts::tables
