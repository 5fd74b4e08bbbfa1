#include "hts/films/coated_index.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hts/error.hpp"

namespace hts {
namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};

Complex square_of(const RefractiveIndex& index) {
    return {(index.n() - index.k()) * (index.n() + index.k()), 2 * index.n() * index.k()};
}

/// N^2 - sin^2, from whichever form does not cancel.
Complex root_squared(const RefractiveIndex& index, double c) {
    const double n = index.n(), k = index.k();
    const Complex excess{(n - 1) * (n + 1) - k * k, 2 * n * k};
    return std::norm(excess) < 0.25 ? excess + c * c : square_of(index) - (1 - c) * (1 + c);
}

/// exp(z) - 1, whose error is relative also near z = 0.
Complex exponential_less_one(double real, double imaginary) {
    const double half = std::sin(imaginary / 2), less = std::expm1(real), cosine = std::cos(imaginary);
    return {less * cosine - 2 * half * half, (less + 1) * std::sin(imaginary)};
}

/// The root with a positive real part of a number whose imaginary part is not
/// negative: quicker than std::sqrt.
Complex root(const Complex& squared, double modulus) {
    const double larger = std::sqrt((modulus + std::abs(squared.real())) / 2);
    const double smaller = larger > 0 ? squared.imag() / (2 * larger) : 0;
    return squared.real() >= 0 ? Complex{larger, smaller} : Complex{smaller, larger};
}

/// C and -i S, see coated_index.hpp.
struct Passage {
    Complex cosine, minus_i_sine, delta;

    Passage(const Complex& squared, double phase) {
        const double modulus = std::sqrt(std::norm(squared));
        const Complex r = root(squared, modulus);
        const Complex less = exponential_less_one(-2 * phase * r.imag(), 2 * phase * r.real());
        cosine = {1 + less.real() / 2, less.imag() / 2};
        minus_i_sine = modulus > 0 ? -less * std::conj(r) * (0.5 / modulus) : Complex{0, -phase};
        delta = phase * r;
    }
    [[nodiscard]] Complex factor() const { return std::exp(i * delta); }
};

/// Derivatives of C and -i S without the factor e^(i delta), which acts on all fields alike.
class PassageGradient {
  public:
    struct By {
        Complex cosine, minus_i_sine, squared;  // squared: of r^2 itself
    };

    PassageGradient(const Passage& at, const Complex& squared, double phase)
        : at_{at}, squared_{squared}, phase_{phase} {}

    /// By r^2, times a derivative of that.
    [[nodiscard]] By by_squared(const Complex& of) const {
        const Complex d = at_.delta * at_.delta;
        // (C k d - S)/(2 r^2), by its series where it cancels
        const Complex sine =
            std::norm(d) > 0.01
                ? (at_.cosine * phase_ - i * at_.minus_i_sine) / (2.0 * squared_)
                : at_.factor() * (phase_ * phase_ * phase_) *
                      (-1.0 / 6 +
                       d * (1.0 / 60 +
                            d * (-1.0 / 1680 + d * (1.0 / 90720 + d * (-1.0 / 7983360 + d / 1037836800.0)))));
        return {-i * at_.minus_i_sine * (phase_ / 2) * of, -i * sine * of, of};
    }
    [[nodiscard]] By by_phase() const { return {-i * at_.minus_i_sine * squared_, -i * at_.cosine, 0}; }

  private:
    const Passage& at_;
    Complex squared_;
    double phase_;
};

/// The field along an interface.
struct Pair {
    Complex b, a;

    /// Above a film of which C and S are known.
    ///   electric   what multiplies S A        magnetic   what multiplies S B
    [[nodiscard]] Pair above(const Passage& film, const Complex& electric, const Complex& magnetic) const {
        return {film.cosine * b + film.minus_i_sine * (electric * a),
                film.cosine * a + film.minus_i_sine * (magnetic * b)};
    }
    /// What makes the larger of both 1.
    [[nodiscard]] double scale() const {
        const double size = std::max(std::max(std::abs(b.real()), std::abs(b.imag())),
                                     std::max(std::abs(a.real()), std::abs(a.imag())));
        return size > 0 ? 1 / size : 1;
    }
    [[nodiscard]] Pair times(double factor) const { return {factor * b, factor * a}; }
};

/// A dB - B dA above a film, by what changes in it.
///   of            of C and -i S
///   factors, by   electric and magnetic of Pair::above, and their derivatives
Complex slope(const Pair& below, const Passage& film, const PassageGradient::By& of, const Pair& factors,
              const Pair& by) {
    const auto& [electric, magnetic] = factors;
    const auto& [b, a] = below;
    const Pair above = below.above(film, electric, magnetic);
    const Complex by_b = of.cosine * b + (of.minus_i_sine * electric + film.minus_i_sine * by.b) * a;
    const Complex by_a = of.cosine * a + (of.minus_i_sine * magnetic + film.minus_i_sine * by.a) * b;
    return above.a * by_b - above.b * by_a;
}

/// Of s and of p.
struct Slopes {
    Complex s, p;
};

Complex reflected(const Pair& at, double c) {
    const Complex below = c * at.b + at.a;
    const double norm = std::norm(below);
    return norm > 0 ? (c * at.b - at.a) * std::conj(below) / norm : Complex{0};
}

}  // namespace

/// The fields of s and p at an interface.
struct CoatedIndex::Ray {
    Pair s, p;
};

CoatedIndex::Layer::Layer(const RefractiveIndex& of, double k_d)
    : index{of}, phase{k_d}, square{square_of(of)}, inverse_square{1.0 / square} {}

CoatedIndex::CoatedIndex(const RefractiveIndex& substrate, std::vector<Layer> layers)
    : substrate_{substrate} {
    if (!layers.empty()) layers_ = std::make_shared<const std::vector<Layer>>(std::move(layers));
}

CoatedIndex::CoatedIndex(const RefractiveIndex& substrate, std::span<const Film> films,
                         const Wavelength& wavelength)
    : substrate_{substrate} {
    if (films.size() > most_films) {
        throw Error{"films: " + std::to_string(films.size()) + " of them: must be at most " +
                    std::to_string(most_films)};
    }
    std::vector<Layer> layers;
    for (const Film& film : films) {
        if (!(film.thickness >= 0 && film.thickness <= thickest))
            throw out_of_range("film thickness", film.thickness, "um", "from 0 to 1000");
        if (film.thickness > 0) layers.emplace_back(film.index, wavelength.wave_number() * film.thickness);
    }
    if (!layers.empty()) layers_ = std::make_shared<const std::vector<Layer>>(std::move(layers));
}

CoatedIndex CoatedIndex::seen_from(double exterior) const {
    const auto relative = [exterior](const RefractiveIndex& index) {
        return RefractiveIndex{index.n() / exterior, index.k() / exterior};
    };
    std::vector<Layer> layers;
    if (layers_) {
        for (const Layer& layer : *layers_)
            layers.emplace_back(relative(layer.index), layer.phase * exterior);
    }
    return {relative(substrate_), std::move(layers)};
}

CoatedIndex CoatedIndex::turned_over() const {
    CoatedIndex relative = seen_from(substrate_.n());
    std::vector<Layer> layers;
    if (relative.layers_) layers.assign(relative.layers_->rbegin(), relative.layers_->rend());
    return {{1 / substrate_.n(), 0}, std::move(layers)};
}

/// From the substrate to the outside. At each film `visit` gets the number of the interface below it, the
/// fields there, the film, and the factors by which the fields of s and p above it are scaled.
template <class Visit>
CoatedIndex::Ray CoatedIndex::walk(double c, Visit&& visit) const noexcept {
    Ray at = deepest(c);
    for (std::size_t j = interfaces() - 1; j > 0; --j) {
        const Layer& layer = (*layers_)[j - 1];
        const Complex& n_squared = layer.square;
        const Complex r_squared = root_squared(layer.index, c);
        const Passage film{r_squared, layer.phase};
        const Ray above{at.s.above(film, 1, r_squared),
                        at.p.above(film, n_squared, r_squared * layer.inverse_square)};
        const double s = above.s.scale(), p = above.p.scale();
        visit(j, at, film, s, p);
        at = {above.s.times(s), above.p.times(p)};
    }
    return at;
}

/// In the substrate, (1, Y).
CoatedIndex::Ray CoatedIndex::deepest(double c) const noexcept {
    const Complex r = std::sqrt(root_squared(substrate_, c));
    return {{1, r}, {1, r / square_of(substrate_)}};
}

FresnelAmplitudes CoatedIndex::amplitudes(double cos_theta) const noexcept {
    if (!layers_) return fresnel(cos_theta, substrate_);
    if (cos_theta == 0) return {-1.0, -1.0};
    const Ray top = walk(cos_theta, [](auto&&...) {});
    return {reflected(top.s, cos_theta), reflected(top.p, cos_theta)};
}

FresnelGradient CoatedIndex::gradient(double cos_theta, std::span<FilmGradient> films) const noexcept {
    if (!layers_) return fresnel_gradient(cos_theta, substrate_);
    const double c = cos_theta, sine_squared = (1 - c) * (1 + c);
    // A dB - B dA at the interface that has been reached, by c and by the substrate's N
    const Complex n{substrate_.n(), substrate_.k()}, n_squared = square_of(substrate_);
    const Ray substrate = deepest(c);
    const Complex root = substrate.s.a,
                  over = root == 0.0 ? Complex{0} : 1.0 / root;  // at the critical angle 0
    Slopes by_cosine{-c * over, -c * over / n_squared},
        by_n{-n * over, n * (2.0 * root / n_squared - over) / n_squared};
    std::array<Slopes, most_films> passed;  // by what those from below a film are multiplied above it
    Complex sum = 1.0 / n_squared;          // (B_s B_p - A_s A_p)/sin^2 theta
    const Ray top = walk(c, [&](std::size_t j, const Ray& at, const Passage& film, double s, double p) {
        const Layer& layer = (*layers_)[j - 1];
        const Complex u = root_squared(layer.index, c), &q = layer.square, over_q = layer.inverse_square;
        const PassageGradient by{film, u, layer.phase};
        const Complex factor = film.factor() * film.factor();
        passed[j - 1] = {factor * s * s, factor * p * p};
        const auto added = [&](const PassageGradient::By& of, const Complex& electric,
                               const Complex& magnetic) {
            return Slopes{slope(at.s, film, of, {1, u}, {0, of.squared}) * (s * s),
                          slope(at.p, film, of, {q, u * over_q}, {electric, magnetic}) * (p * p)};
        };
        const Slopes own = added(by.by_squared(2 * c), 0, 2 * c * over_q);
        by_cosine = {by_cosine.s * passed[j - 1].s + own.s, by_cosine.p * passed[j - 1].p + own.p};
        by_n = {by_n.s * passed[j - 1].s, by_n.p * passed[j - 1].p};
        const Complex &m = film.minus_i_sine, &cosine = film.cosine;
        sum =
            ((cosine * cosine - m * m * q) * sum + cosine * m * (at.s.b * at.p.a + at.s.a * at.p.b * over_q) +
             m * m * (2.0 - sine_squared * over_q) * at.s.b * at.p.b) *
            (s * p);
        if (films.empty()) return;
        const Complex by_square = 2.0 * Complex{layer.index.n(), layer.index.k()};
        const Slopes of_n =
            added(by.by_squared(by_square), by_square, sine_squared * over_q * over_q * by_square);
        const Slopes of_phase = added(by.by_phase(), 0, 0);
        films[j - 1] = {{of_n.s, of_n.p}, {of_phase.s, of_phase.p}};
    });
    const Complex s_below = c * top.s.b + top.s.a, p_below = c * top.p.b + top.p.a;
    const Slopes scale{2.0 / (s_below * s_below), 2.0 / (p_below * p_below)};
    const auto amplitudes = [&](const Slopes& of) {
        return FresnelAmplitudes{c * scale.s * of.s, c * scale.p * of.p};
    };
    Slopes above{1, 1};
    for (std::size_t j = 0; j < films.size(); ++j) {
        const auto through = [&](const FresnelAmplitudes& of) {
            return amplitudes({above.s * of.s, above.p * of.p});
        };
        films[j] = {through(films[j].by_n), through(films[j].by_phase)};
        above = {above.s * passed[j].s, above.p * passed[j].p};
    }
    const FresnelAmplitudes by_c = amplitudes(by_cosine);
    return {
        c == 0 ? FresnelAmplitudes{-1.0, -1.0} : FresnelAmplitudes{reflected(top.s, c), reflected(top.p, c)},
        {by_c.s + scale.s * top.s.a * top.s.b, by_c.p + scale.p * top.p.a * top.p.b},
        amplitudes(by_n),
        2.0 * (sum - top.s.b * top.p.b) / (s_below * p_below)};
}

double CoatedIndex::transmittance(double cos_theta) const noexcept {
    const double c = cos_theta;
    if (c == 0) return 0;
    double s = 1, p = 1;
    const Ray top =
        walk(c, [&](std::size_t, const Ray&, const Passage& film, double s_scale, double p_scale) {
            const double left = std::abs(film.factor());
            s *= left * s_scale;
            p *= left * p_scale;
        });
    const Ray substrate = deepest(c);
    const auto entered = [c](const Pair& at, double factor, const Complex& admittance) {
        const double field = factor / std::abs(c * at.b + at.a);
        return 4 * c * admittance.real() * field * field;
    };
    return (entered(top.s, s, substrate.s.a) + entered(top.p, p, substrate.p.a)) / 2;
}

void CoatedIndex::fields(double cos_theta, double lift, std::span<Fields> fields) const noexcept {
    std::array<Complex, most_films + 1> s_factors, p_factors;
    const Ray top = walk(
        cos_theta, [&](std::size_t j, const Ray& at, const Passage& film, double s_scale, double p_scale) {
            fields[j] = {at.s.b, at.p.b, at.p.a};
            s_factors[j] = film.factor() * s_scale;
            p_factors[j] = film.factor() * p_scale;
        });
    fields[0] = {top.s.b, top.p.b, top.p.a};
    Complex s = 1.0 / (cos_theta * top.s.b + top.s.a), p = 1.0 / ((cos_theta + lift) * top.p.b + top.p.a);
    for (std::size_t j = 0; j < interfaces(); ++j) {
        if (j > 0) {
            s *= s_factors[j];
            p *= p_factors[j];
        }
        fields[j] = {s * fields[j].s, p * fields[j].p, p * fields[j].p_electric};
    }
}

Complex CoatedIndex::square_below(std::size_t interface_number) const noexcept {
    return square_of(interface_number + 1 < interfaces() ? (*layers_)[interface_number].index : substrate_);
}

Complex CoatedIndex::normal_impedance() const noexcept {
    if (!layers_) return 1.0 / Complex{substrate_.n(), substrate_.k()};
    const Ray top = walk(1, [](auto&&...) {});
    return top.p.a / top.p.b;
}

std::vector<std::array<double, 3>> CoatedIndex::film_numbers() const {
    std::vector<std::array<double, 3>> numbers;
    if (layers_) {
        for (const Layer& layer : *layers_)
            numbers.push_back({layer.index.n(), layer.index.k(), layer.phase});
    }
    return numbers;
}

}  // namespace hts
