/// One lobe of a density of normals, for normal_density.cpp alone.
#pragma once

#include <memory>

#include "hts/microfacet/normals/normal_density.hpp"

namespace hts {

/// Values and integrals of a normalised density. The square (u, v) in [0, 1)^2 is spread over the sphere with
/// a smooth density near p, for sums; `draw` does so with `draw_density`, the same unless overridden.
class NormalLobe {
  public:
    virtual ~NormalLobe() = default;

    [[nodiscard]] virtual double value(Vector3 h) const noexcept = 0;
    [[nodiscard]] virtual Vector3 mean() const noexcept = 0;
    /// <h.n> with what is counted there only.
    [[nodiscard]] virtual double projection() const noexcept { return mean().z; }
    [[nodiscard]] virtual double projected_area(Vector3 k) const = 0;
    [[nodiscard]] virtual Vector3 spread(double u, double v) const noexcept = 0;
    [[nodiscard]] virtual double spread_density(Vector3 h) const noexcept = 0;
    [[nodiscard]] virtual Vector3 draw(const Uniforms& u) const noexcept { return spread(u[1], u[2]); }
    [[nodiscard]] virtual double draw_density(Vector3 h) const noexcept { return spread_density(h); }
};

/// Gaussian slopes about a pole tilted towards +x; `tops` times the projection is counted besides in <h.n>.
class GaussianFacets final : public NormalLobe {
  public:
    GaussianFacets(double sigma_x, double sigma_y, double tilt = 0, double tops = 0);

    [[nodiscard]] double value(Vector3 h) const noexcept override;
    [[nodiscard]] Vector3 mean() const noexcept override;
    [[nodiscard]] double projection() const noexcept override { return (1 + tops_) * mean().z; }
    [[nodiscard]] double projected_area(Vector3 k) const override;
    [[nodiscard]] Vector3 spread(double u, double v) const noexcept override;
    [[nodiscard]] double spread_density(Vector3 h) const noexcept override;

  private:
    [[nodiscard]] Vector3 to_pole(Vector3 h) const noexcept;
    [[nodiscard]] Vector3 from_pole(Vector3 h) const noexcept;

    double a_x_, a_y_;  // 1/sigma^2
    double cos_tilt_, sin_tilt_, tops_;
    double scale_ = 1, mean_length_ = 0;
};

/// Velvet: normals about the horizon.
class UprightFibres final : public NormalLobe {
  public:
    explicit UprightFibres(double sigma);

    [[nodiscard]] double value(Vector3 h) const noexcept override;
    [[nodiscard]] Vector3 mean() const noexcept override { return {0, 0, mean_z_}; }
    [[nodiscard]] double projected_area(Vector3 k) const override;
    [[nodiscard]] Vector3 spread(double u, double v) const noexcept override;
    [[nodiscard]] double spread_density(Vector3 h) const noexcept override;

  private:
    double a_, kappa_;
    double scale_ = 1, mean_z_ = 0;
};

/// What densities given by samples share: sums over fixed points stand for the integrals.
class SampledFacets : public NormalLobe {
  public:
    [[nodiscard]] Vector3 mean() const noexcept override { return mean_; }
    [[nodiscard]] double projected_area(Vector3 k) const override;

  protected:
    /// Sets the scale so that `value` has integral 1; the last thing a constructor does.
    void normalise(std::size_t per_side_u, std::size_t per_side_v);
    double scale_ = 1;

  private:
    std::vector<WeightedNormal> points_;
    Vector3 mean_{};
};

class TabulatedFacets final : public SampledFacets {
  public:
    explicit TabulatedFacets(ValueGrid grid);

    [[nodiscard]] double value(Vector3 h) const noexcept override;
    [[nodiscard]] Vector3 spread(double u, double v) const noexcept override;
    [[nodiscard]] double spread_density(Vector3 h) const noexcept override;
    [[nodiscard]] Vector3 draw(const Uniforms& u) const noexcept override;
    [[nodiscard]] double draw_density(Vector3 h) const noexcept override;
    [[nodiscard]] bool mirror_x() const noexcept;
    [[nodiscard]] bool mirror_y() const noexcept;

  private:
    /// The value at row i, column j, which may exceed the last one.
    [[nodiscard]] double at(std::size_t i, std::size_t j) const noexcept;
    [[nodiscard]] double cosine(std::size_t row) const noexcept;

    ValueGrid grid_;
    std::vector<double> sums_;  // of the masses of the cells, row by row, the last one 1
};

class PicturedFacets final : public SampledFacets {
  public:
    PicturedFacets(GaussianFacets facets, ValueGrid pixels, double extent);

    [[nodiscard]] double value(Vector3 h) const noexcept override;
    [[nodiscard]] Vector3 spread(double u, double v) const noexcept override { return facets_.spread(u, v); }
    [[nodiscard]] double spread_density(Vector3 h) const noexcept override {
        return facets_.spread_density(h);
    }

  private:
    [[nodiscard]] double pixel(Vector3 h) const noexcept;

    GaussianFacets facets_;
    ValueGrid pixels_;
    double extent_;
};

}  // namespace hts
