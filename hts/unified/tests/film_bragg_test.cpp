// Bragg's matrix of a rough substrate under conformal films, against the boundary conditions themselves.
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/unified/he_unified_spectrum.hpp"
#include "hts/unified/unified_terms.hpp"

using hts::bragg_jones;
using hts::CoatedIndex;
using hts::Direction;
using hts::Film;
using hts::JonesMatrix;
using hts::RefractiveIndex;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};
const auto wavelength = Wavelength::from_micrometres(2 * std::numbers::pi);  // k = 1

struct Vector {
    Complex x, y, z;
    friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator*(const Complex& f, const Vector& a) { return {f * a.x, f * a.y, f * a.z}; }
};
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Complex dot(const Vector& a, const hts::Vector3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// E and H at a height.
struct Field {
    Vector e, h;
    friend Field operator+(const Field& a, const Field& b) { return {a.e + b.e, a.h + b.h}; }
    friend Field operator*(const Complex& f, const Field& a) { return {f * a.e, f * a.h}; }
};

/// A plane wave exp(i(kx x + ky y + q (z - origin))), of unit E across its plane or unit H.
struct Wave {
    Vector k;
    Field field;
    double origin;

    Wave(double kx, double ky, Complex q, Complex epsilon, bool is_p, double at) : k{kx, ky, q}, origin{at} {
        const double size = std::hypot(kx, ky);
        const Vector across{size > 0 ? ky / size : 0, size > 0 ? -kx / size : -1, 0};
        const Vector other = cross(k, across);
        field = is_p ? Field{(-1.0 / epsilon) * other, across} : Field{across, other};
    }
    [[nodiscard]] Field at(double z) const { return std::exp(i * k.z * (z - origin)) * field; }
    [[nodiscard]] Field slope(double z) const { return i * k.z * at(z); }
};

/// Gaussian elimination with pivots.
std::vector<Complex> solution(std::vector<std::vector<Complex>> rows, std::vector<Complex> right) {
    const std::size_t n = rows.size();
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t best = column;
        for (std::size_t row = column; row < n; ++row)
            if (std::abs(rows[row][column]) > std::abs(rows[best][column])) best = row;
        std::swap(rows[best], rows[column]);
        std::swap(right[best], right[column]);
        for (std::size_t row = 0; row < n; ++row) {
            if (row == column) continue;
            const Complex f = rows[row][column] / rows[column][column];
            for (std::size_t j = column; j < n; ++j) rows[row][j] -= f * rows[column][j];
            right[row] -= f * right[column];
        }
    }
    for (std::size_t row = 0; row < n; ++row) right[row] /= rows[row][row];
    return right;
}

/// The stack as media between interfaces at heights z_0 = 0 > z_1 > …
struct Media {
    std::vector<Complex> squares;  // above the first interface, between, below the last
    std::vector<double> heights;

    Media(const RefractiveIndex& substrate, const std::vector<Film>& films) : squares{1}, heights{0} {
        for (const Film& film : films) {
            squares.push_back(std::pow(Complex{film.index.n(), film.index.k()}, 2));
            heights.push_back(heights.back() - film.thickness);
        }
        squares.push_back(std::pow(Complex{substrate.n(), substrate.k()}, 2));
    }
};

/// All outgoing waves of one horizontal wave vector: up in the first medium, both ways
/// between, down in the last.
struct Outgoing {
    struct Part {
        std::size_t medium;
        Wave wave;
    };
    std::vector<Part> parts;

    Outgoing(const Media& media, double kx, double ky) {
        for (std::size_t m = 0; m < media.squares.size(); ++m) {
            const Complex square = media.squares[m], q = std::sqrt(square - kx * kx - ky * ky);
            for (const bool is_p : {false, true}) {
                if (m + 1 < media.squares.size())
                    parts.push_back({m, {kx, ky, q, square, is_p, media.heights[m]}});
                if (m > 0) parts.push_back({m, {kx, ky, -q, square, is_p, media.heights[m - 1]}});
            }
        }
    }
    /// Amplitudes for which E and H along each interface jump by what is given.
    [[nodiscard]] std::vector<Complex> amplitudes(const Media& media, const std::vector<Field>& jumps) const {
        std::vector<std::vector<Complex>> rows;
        std::vector<Complex> right;
        for (std::size_t j = 0; j < media.heights.size(); ++j) {
            for (int component = 0; component < 4; ++component) {
                const auto of = [component](const Field& f) {
                    return std::array{f.e.x, f.e.y, f.h.x, f.h.y}[static_cast<std::size_t>(component)];
                };
                std::vector<Complex> row;
                for (const Part& part : parts) {
                    const double sign = part.medium == j ? 1 : part.medium == j + 1 ? -1 : 0;
                    row.push_back(sign == 0 ? 0 : sign * of(part.wave.at(media.heights[j])));
                }
                rows.push_back(row);
                right.push_back(of(jumps[j]));
            }
        }
        return solution(rows, right);
    }
};

/// E of the wave reflected in first order by heights exp(i(kx x + ky y)) of all interfaces, for an
/// incident wave of unit E.
///   boundary   n x E and n x H are continuous at z_j + h, n = (-dh/dx, -dh/dy, 1), to first order in h
Vector reflected_in_first_order(const Media& media, const Direction& in, const Direction& out, bool is_p) {
    const hts::Vector3 a = in.vector(), b = out.vector();
    const Wave incident{-a.x, -a.y, -a.z, 1, is_p, 0};
    const std::size_t count = media.heights.size();
    std::vector<Field> jumps(count, Field{});
    jumps[0] = -1.0 * incident.at(0);
    const Outgoing smooth{media, -a.x, -a.y};
    const auto amplitudes = smooth.amplitudes(media, jumps);
    const double dx = b.x + a.x, dy = b.y + a.y;
    std::vector<Field> steps;
    for (std::size_t j = 0; j < count; ++j) {
        Field value{}, slope{};  // above less below
        const auto add = [&](const Wave& wave, Complex factor) {
            value = value + factor * wave.at(media.heights[j]);
            slope = slope + factor * wave.slope(media.heights[j]);
        };
        if (j == 0) add(incident, 1);
        for (std::size_t w = 0; w < smooth.parts.size(); ++w) {
            const std::size_t medium = smooth.parts[w].medium;
            if (medium == j) add(smooth.parts[w].wave, amplitudes[w]);
            if (medium == j + 1) add(smooth.parts[w].wave, -amplitudes[w]);
        }
        const auto tilt = [&](const Complex& vertical) {
            return Vector{i * dx * vertical, i * dy * vertical, 0};
        };
        steps.push_back({-1.0 * (slope.e + tilt(value.e.z)), -1.0 * (slope.h + tilt(value.h.z))});
    }
    const Outgoing scattered{media, b.x, b.y};
    const auto first = scattered.amplitudes(media, steps);
    Vector sum{};
    for (std::size_t w = 0; w < scattered.parts.size(); ++w)
        if (scattered.parts[w].medium == 0) sum = sum + first[w] * scattered.parts[w].wave.at(0).e;
    return sum;
}

/// The same as a Jones matrix in the frames of polarisation.hpp.
JonesMatrix by_boundary_conditions(const Media& media, const Direction& in, const Direction& out) {
    const hts::Vector3 s_in = s_vector_of_incident(in), s_out = s_vector_of_reflected(out);
    const hts::Vector3 a = in.vector(), b = out.vector();
    const hts::Vector3 p_in = hts::cross(s_in, -1 * a), p_out = hts::cross(s_out, b);
    // the incident waves of unit E along s and p
    JonesMatrix result{};
    for (const bool is_p : {false, true}) {
        const Wave incident{-a.x, -a.y, -a.z, 1, is_p, 0};
        const Complex unit = 1.0 / dot(incident.field.e, is_p ? p_in : s_in);
        const Vector e = unit * reflected_in_first_order(media, in, out, is_p);
        (is_p ? result.sp : result.ss) = dot(e, s_out);
        (is_p ? result.pp : result.ps) = dot(e, p_out);
    }
    return result;
}

double distance(const JonesMatrix& a, const JonesMatrix& b, Complex factor = 1) {
    return std::max(std::max(std::abs(a.ss - factor * b.ss), std::abs(a.sp - factor * b.sp)),
                    std::max(std::abs(a.ps - factor * b.ps), std::abs(a.pp - factor * b.pp)));
}
double size(const JonesMatrix& a) {
    return distance(a, {});
}

struct Case {
    RefractiveIndex substrate;
    std::vector<Film> films;
    Direction in, out;

    [[nodiscard]] CoatedIndex index() const { return {substrate, films, wavelength}; }
    [[nodiscard]] JonesMatrix bragg() const { return bragg_jones(in, out, index(), 0); }
    [[nodiscard]] std::string text() const {
        std::ostringstream text;
        text << films.size() << " films on " << substrate.n() << " + " << substrate.k() << "i, cosines "
             << in.cos_theta() << ", " << out.cos_theta();
        return text.str();
    }
};

RefractiveIndex random_index(Random& random) {
    return {random.logarithmic(0.1, 5), random.one_of({0, 0, 0.1, 2, 5})};
}

Case random_case(Random& random, int films) {
    Case result{random_index(random), {}, random.direction(0.02), random.direction(0.02)};
    for (int j = 0; j < films; ++j)
        result.films.push_back({random_index(random), random.logarithmic(0.01, 3)});
    return result;
}

}  // namespace

TEST_CASE("Bragg of films: the boundary conditions at every interface to first order") {
    WorstCase bare{"Bragg's matrix of a bare surface", 1e-13}, coated{"Bragg's matrix under films", 3e-13};
    Random random{11};
    for (int n = 0; n < 600; ++n) {
        const Case c = random_case(random, n % 4);
        const JonesMatrix expected = by_boundary_conditions({c.substrate, c.films}, c.in, c.out);
        const JonesMatrix b = c.bragg();
        // a surface lifted by h reflects F exp(-2ik c h)
        const double error = distance(expected, b, -2.0 * i * c.in.cos_theta()) / size(expected);
        (n % 4 == 0 ? bare : coated).note(error, [&] { return c.text(); });
    }
    bare.check();
    coated.check();
}

TEST_CASE("Bragg of films: towards the mirror it is the stack's own reflection, to second order") {
    Random random{12};
    for (int n = 0; n < 100; ++n) {
        const Case c = random_case(random, 1 + n % 3);
        const double theta = random.uniform(0.05, 1.4), azimuth = random.uniform(0, 6);
        const auto between = [&](double step) {
            const Direction in = Direction::from_angles(theta, azimuth);
            const Direction out =
                Direction::from_angles(theta + 0.7 * step, azimuth + std::numbers::pi + step);
            const double facet = wave_vector_change(in, out).cos_theta_d();
            const JonesMatrix k = facet_jones(in, out, c.index().amplitudes(facet));
            const JonesMatrix b = bragg_jones(in, out, c.index(), 0);
            const double cosines = 2 * in.cos_theta() * out.cos_theta();
            return distance({2 * facet * facet * k.ss, 2 * facet * facet * k.sp, 2 * facet * facet * k.ps,
                             2 * facet * facet * k.pp},
                            b, cosines);
        };
        INFO(c.text() << ", theta " << theta);
        CHECK(between(0) < 1e-12);
        const double coarse = between(2e-4), fine = between(1e-4);
        if (coarse > 1e-10) CHECK(coarse / fine == Approx(4).epsilon(0.05));
    }
}

TEST_CASE("Bragg of films: reciprocal, and without effect where film and substrate are one") {
    Random random{13};
    for (int n = 0; n < 200; ++n) {
        Case c = random_case(random, 1 + n % 3);
        const JonesMatrix b = c.bragg();
        const JonesMatrix turned = bragg_jones(c.out, c.in, c.index(), 0);  // the azimuth turns its sign
        CHECK(distance(b, {turned.ss, -turned.ps, -turned.sp, turned.pp}) <= 1e-12 * size(b));
        for (Film& film : c.films) film.index = c.substrate;
        CHECK(distance(c.bragg(), bragg_jones(c.in, c.out, c.substrate, 0)) <= 1e-9 * size(c.bragg()));
    }
}

TEST_CASE("Bragg of films: the lift of a film too thin to matter is that of the bare surface") {
    const Direction in = Direction::from_degrees(80, 0), out = Direction::from_degrees(70, 150);
    const RefractiveIndex gold{0.16, 3.6};
    const CoatedIndex thin{gold, std::vector<Film>{{{1.5, 0}, 1e-13}}, wavelength};
    const JonesMatrix a = bragg_jones(in, out, thin, 0.01), b = bragg_jones(in, out, gold, 0.01);
    CHECK(distance(a, b) < 1e-11 * size(b));
    CHECK(distance(bragg_jones(in, out, gold, 0), b) > 1e-3 * size(b));
}

TEST_CASE("he_unified under films: reciprocal lobes, smooth and rough limits") {
    const std::vector<Film> films{{{1.38, 0}, 0.09}, {{2.2, 0.02}, 0.05}};
    const auto green = Wavelength::from_micrometres(0.55);
    const CoatedIndex index{{0.9, 6}, films, green};
    const Direction in = Direction::from_degrees(40, 0), out = Direction::from_degrees(55, 150);
    const auto value = [&](const hts::Surface& surface, const CoatedIndex& of, const Direction& a,
                           const Direction& b) {
        double result = 0;
        hts::HeUnifiedSpectrum{surface, {{green, of, 0}}, hts::Tolerance{1e-12}}.brdf({a, b}, {&result, 1});
        return result;
    };
    const hts::Surface middle{0.1, 0.9};
    CHECK(value(middle, index, in, out) == Approx(value(middle, index, out, in)).epsilon(1e-13));
    // smooth: Rayleigh-Rice, 16 pi^2/lambda^4 c_i c_r |b|^2 times the spectrum
    const hts::Surface smooth{5e-5, 0.5};
    const JonesMatrix b = bragg_jones(in, out, index, 0);
    const double k = green.wave_number(), tau = 0.5, c = in.cos_theta() * out.cos_theta();
    const double horizontal = wave_vector_change(in, out).horizontal;
    const double spectrum =
        25e-10 * std::numbers::pi * tau * tau * std::exp(-std::pow(k * horizontal * tau, 2) / 4);
    const double norm = (std::norm(b.ss) + std::norm(b.sp) + std::norm(b.ps) + std::norm(b.pp)) / 2;
    CHECK(value(smooth, index, in, out) ==
          Approx(std::pow(k, 4) / (std::numbers::pi * std::numbers::pi) * c * norm * spectrum).epsilon(2e-6));
    // rough: facets of the stack's reflectance at theta_d, returned light apart
    const hts::Surface rough{20, 400};
    const double facet = wave_vector_change(in, out).cos_theta_d();
    const double ratio = value(rough, index, in, out) / value(rough, {0.9, 6}, in, out);
    CHECK(ratio == Approx(index.amplitudes(facet).unpolarised_reflectance() /
                          hts::fresnel(facet, {0.9, 6}).unpolarised_reflectance())
                       .epsilon(2e-3));
    // a film of the substrate: the bare surface, lanes apart
    const CoatedIndex same{{0.9, 6}, std::vector<Film>{{{0.9, 6}, 0.1}}, green};
    CHECK(value(middle, same, in, out) == Approx(value(middle, {0.9, 6}, in, out)).epsilon(1e-12));
}
