// Lit objects whose surface the shader does not know.

#include <vector>

#include "engine.hpp"
#include "hts/error.hpp"

namespace hts::page {
namespace {

constexpr std::size_t columns = 9, results = 12;

Direction direction_at(std::span<const double> numbers) {
    return Direction::from_vector({numbers[0], numbers[1], numbers[2]});
}

class Pixels {
  public:
    explicit Pixels(const json& request)
        : brdf_{reflectance_of(request)},
          sampler_{sampler_of(request)},
          weights_(request.at("weights")),
          spectrum_(brdf_.size()) {
        if (weights_.size() != 3 * brdf_.size())
            throw Error{"weights: " + std::to_string(weights_.size()) + ": must be " +
                        std::to_string(3 * brdf_.size())};
    }

    void shade(std::span<const double> in, std::span<double> out) {
        const Direction view = direction_at(in);
        if (in[5] > 0) {
            brdf_.brdf({direction_at(in.subspan(3)), view}, spectrum_);
            add_colour(out, 1);
        }
        brdf_.specular_reflectance(view, spectrum_);
        add_colour(out.subspan(3), 1);
        const Draw drawn = sampler_.draw(view, {in[6], in[7], in[8]});
        if (drawn.lobe == Lobe::specular || drawn.lobe == Lobe::none || !(drawn.pdf > 0)) return;
        brdf_.brdf({drawn.out, view}, spectrum_);
        add_colour(out.subspan(6), drawn.out.cos_theta() / drawn.pdf);
        const auto [x, y, z] = drawn.out.vector();
        out[9] = x;
        out[10] = y;
        out[11] = z;
    }

  private:
    void add_colour(std::span<double> colour, double factor) const {
        for (std::size_t w = 0; w < spectrum_.size(); ++w)
            for (std::size_t c = 0; c < 3; ++c) colour[c] += factor * weights_[3 * w + c] * spectrum_[w];
    }

    const spectral::Reflectance& brdf_;
    const spectral::Sampler& sampler_;
    std::vector<double> weights_, spectrum_;
};

}  // namespace

json picture(const json& request, const Numbers& numbers) {
    const std::size_t count = numbers.in.size() / columns;
    numbers.require(columns * count, results * count);
    std::fill(numbers.out.begin(), numbers.out.end(), 0.0);
    Pixels pixels{request};
    for (std::size_t i = 0; i < count; ++i)
        pixels.shade(numbers.in.subspan(columns * i, columns), numbers.out.subspan(results * i, results));
    return {{"count", count}};
}

}  // namespace hts::page
