/// A BRDF as means over pairs of patches of the hemisphere, the way WINDOW and Radiance keep glazing: the
/// bases of J. H. Klems (ASHRAE Transactions 100(1), 1994).
///
/// A patch is a stretch of a ring of polar angles; a ring's patches are centred on azimuths 0, 360/n, ... An
/// incident patch is that of the direction in which the light travels on, (theta, phi + 180 deg), so that the
/// mirror direction of patch k is in patch k. A view is in the patch of its own direction. Patches of a
/// quarter of a turn by 15 degrees hold no lobe narrower than that.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

class KlemsBasis {
  public:
    /// 145, 73 or 41 patches.
    static const KlemsBasis& full();
    static const KlemsBasis& half();
    static const KlemsBasis& quarter();
    /// "LBNL/Klems Full", "… Half" or "… Quarter", else hts::Error.
    static const KlemsBasis& named(std::string_view name);

    /// A stretch of polar angles [deg] and its number of patches.
    struct Ring {
        double low, high;
        std::size_t patches;
    };
    /// Any basis.
    ///   rings   from 0 to 90 degrees without gaps, 1 to 10000 patches each; else hts::Error
    KlemsBasis(std::string name, std::vector<Ring> rings);

    [[nodiscard]] const std::vector<Ring>& rings() const noexcept { return rings_; }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// The patch of a direction.
    [[nodiscard]] std::size_t patch(const Direction& direction) const noexcept;
    /// Integral of cos theta over a patch [sr]; their sum is pi.
    [[nodiscard]] double projected_solid_angle(std::size_t patch) const;
    /// A point of a patch, of equal projected solid angle for equal steps.
    ///   across, along   0 ... 1 over polar angle and azimuth
    [[nodiscard]] Direction point(std::size_t patch, double across, double along) const;

  private:
    [[nodiscard]] std::size_t ring_of(std::size_t patch, std::size_t& place) const;

    std::string name_;
    std::vector<Ring> rings_;
    std::size_t size_ = 0;
};

/// Means of a BRDF over all pairs of patches, weighted by projected solid angle [1/sr], of each wavelength at
/// [view * size + light]; 512 to 32768 points per pair, until twice as many change the mean by 1 % at most.
///   specular   whether the specular term is added: a patch of light is mirrored into the
///              patch of the same number
[[nodiscard]] std::vector<std::vector<double>> klems_means(const spectral::Reflectance& brdf,
                                                           const KlemsBasis& basis, bool specular = false);

/// The means as a BRDF, constant within patches.
///   means   basis.size()^2 of them, >= 0
[[nodiscard]] spectral::Reflectance klems_brdf(const std::string& name,
                                               const spectral::WavelengthGrid& wavelength,
                                               const KlemsBasis& basis, std::vector<double> means);

}  // namespace hts::tables
