#include "validation/scattering/vector/conductor_patch.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hts/polarisation.hpp"
#include "hts/unified/unified_terms.hpp"
#include "validation/scattering/boundary_integral.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi, degree = pi / 180, k = 2 * pi;

RandomField flat(double length, std::size_t points) {
    const auto side = static_cast<std::size_t>(std::lround(length * static_cast<double>(points)));
    const std::vector<double> zero(side * side);
    return {1 / static_cast<double>(points), side, zero, zero, zero};
}

RandomField scaled(RandomField field, double by) {
    for (auto* values : {&field.height, &field.slope_x, &field.slope_y}) {
        for (double& value : *values) value *= by;
    }
    return field;
}

/// The same surface by the middle one of every so many samples, an odd number.
RandomField thinned(const RandomField& fine, std::size_t every) {
    const std::size_t side = fine.samples / every;
    RandomField coarse{fine.step * static_cast<double>(every), side, {}, {}, {}};
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t at = (every * j + every / 2) * fine.samples + every * i + every / 2;
            coarse.height.push_back(fine.height[at]);
            coarse.slope_x.push_back(fine.slope_x[at]);
            coarse.slope_y.push_back(fine.slope_y[at]);
        }
    }
    return coarse;
}

/// Directions of a hemisphere, with their solid angles.
struct Sphere {
    std::vector<Direction> out;
    std::vector<double> weights;
};
Sphere hemisphere(int polar, int round) {
    Sphere sphere;
    for (int i = 0; i < polar; ++i) {
        const double theta = (i + 0.5) * pi / 2 / polar;
        for (int j = 0; j < round; ++j) {
            sphere.out.push_back(Direction::from_angles(theta, (j + 0.5) * 2 * pi / round));
            sphere.weights.push_back(std::sin(theta) * pi / 2 / polar * 2 * pi / round);
        }
    }
    return sphere;
}

std::vector<const Currents*> pointers(const std::vector<Currents>& all) {
    std::vector<const Currents*> result;
    for (const Currents& each : all) result.push_back(&each);
    return result;
}

/// Currents of s and p, solved.
std::vector<Currents> solved(const ConductorPatch& patch, const PlaneWaveBeam& beam, double tolerance) {
    const auto right = patch.kirchhoff(beam);
    return patch.solved({right[0], right[1]}, tolerance).of;
}

std::vector<std::vector<FarAmplitude>> far(const ConductorPatch& patch, const PlaneWaveBeam& beam,
                                           const std::vector<Direction>& out, double tolerance = 1e-4) {
    return patch.radiated(pointers(solved(patch, beam, tolerance)), out);
}

/// Relative distance of two fields in all directions and both incident states.
double off(const std::vector<std::vector<FarAmplitude>>& a, const std::vector<std::vector<FarAmplitude>>& b) {
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < a[i].size(); ++j) {
            difference += std::norm(a[i][j].s - b[i][j].s) + std::norm(a[i][j].p - b[i][j].p);
            sum += std::norm(b[i][j].s) + std::norm(b[i][j].p);
        }
    }
    return std::sqrt(difference / sum);
}

}  // namespace

TEST_CASE("conductor patch: a flat plate mirrors everything in its own polarisation") {
    const ConductorPatch patch{flat(12, 6)};
    const Sphere sphere = hemisphere(30, 90);
    for (const double theta : {20.0, 60.0}) {
        const PlaneWaveBeam beam{theta * degree, 0.3, 2, 15};
        const auto amplitudes = far(patch, beam, sphere.out);
        for (std::size_t state = 0; state < 2; ++state) {
            double own = 0, cross = 0;
            for (std::size_t i = 0; i < sphere.out.size(); ++i) {
                const double s = std::norm(amplitudes[state][i].s), p = std::norm(amplitudes[state][i].p);
                own += sphere.weights[i] * (state == 0 ? s : p) / beam.power();
                cross += sphere.weights[i] * (state == 0 ? p : s) / beam.power();
            }
            std::printf("flat plate, %g deg: %.5f and %.1e\n", theta, own, cross);
            CHECK(own == Approx(1).epsilon(theta < 50 ? 1e-3 : 5e-3));
            CHECK(cross < 1e-3);
        }
    }
}

TEST_CASE(
    "conductor patch: what GMRES finds solves the equation, by the same bits for any number of threads") {
    const ConductorPatch patch{random_field({0.3, 1}, 0.2, 40, 3)};
    const PlaneWaveBeam beam{40 * degree, 0, 1.4, 10};
    const auto right = patch.kirchhoff(beam);
    const std::vector<Currents> both{right[0], right[1]};
    const SolvedCurrents solution = patch.solved(both, 1e-3);
    const auto image = patch.applied(pointers(solution.of));
    for (std::size_t i = 0; i < both.size(); ++i) {
        double residual = 0, size = 0;
        for (std::size_t j = 0; j < both[i].size(); ++j) {
            residual += std::norm(image[i][j] - both[i][j]);
            size += std::norm(both[i][j]);
        }
        std::printf("residual %.2e after %d products\n", std::sqrt(residual / size), solution.iterations[i]);
        CHECK(std::sqrt(residual / size) < 1.05e-3);
        CHECK(solution.iterations[i] < 20);
    }
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const SolvedCurrents alone = patch.solved(both, 1e-3);
    omp_set_num_threads(3);
    CHECK(patch.solved(both, 1e-3).of == alone.of);
    omp_set_num_threads(threads);
    CHECK(solution.of == alone.of);
}

TEST_CASE("conductor patch: the error falls with the third power of the step") {
    const Sphere sphere = hemisphere(10, 24);
    const PlaneWaveBeam beam{40 * degree, 0, 1, 7};
    const RandomField fine = random_field({0.25, 1}, 1.0 / 15, 75, 5);
    const auto amplitudes = [&](std::size_t every) {
        return far(ConductorPatch{thinned(fine, every)}, beam, sphere.out);
    };
    const auto exact = amplitudes(1);
    const double at_5 = off(amplitudes(3), exact), at_3 = off(amplitudes(5), exact);
    std::printf("field error at 5 points per wavelength %.4f, at 3 %.4f\n", at_5, at_3);
    CHECK(at_5 < 0.01);
    CHECK(at_3 < 0.1);
    CHECK(at_3 > 3 * at_5);
}

TEST_CASE("conductor patch: the points per wavelength of the study suffice to 0.2 dB of each bin") {
    struct Case {
        double sigma, tau, step;
        std::size_t samples, kept, finer;  // of the finest surface; every so many are taken
    };
    constexpr int polar = 45, round = 72, polar_bin = 5, round_bin = 8;  // 10 by 40 degrees
    const Sphere sphere = hemisphere(polar, round);
    for (const Case& of : {Case{0.3, 1, 1.0 / 25, 240, 5, 3}, Case{0.15, 0.5, 1.0 / 30, 270, 5, 3}}) {
        const RandomField fine = random_field({of.sigma, of.tau}, of.step, of.samples, 29);
        const double side = of.step * static_cast<double>(of.samples);
        const PlaneWaveBeam beam{40 * degree, 0, side / 6, 1.25 * side};
        const auto bins = [&](std::size_t every) {
            const auto amplitudes = far(ConductorPatch{thinned(fine, every)}, beam, sphere.out, 1e-3);
            std::vector<double> energy(2 * 2 * (polar / polar_bin) * (round / round_bin));
            for (std::size_t state = 0; state < 2; ++state) {
                for (std::size_t i = 0; i < sphere.out.size(); ++i) {
                    const std::size_t bin =
                        i / round / polar_bin * (round / round_bin) + i % round / round_bin;
                    energy[4 * bin + 2 * state] += sphere.weights[i] * std::norm(amplitudes[state][i].s);
                    energy[4 * bin + 2 * state + 1] += sphere.weights[i] * std::norm(amplitudes[state][i].p);
                }
            }
            return energy;
        };
        const auto coarse = bins(of.kept), exact = bins(of.finer);
        double all = 0, squares = 0, worst = 0;
        for (const double energy : exact) all += energy;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const double off_db = 10 * std::log10(coarse[i] / exact[i]);
            squares += exact[i] / all * off_db * off_db;
            if (exact[i] > 1e-3 * all) worst = std::fmax(worst, std::fabs(off_db));
        }
        std::printf("(%g, %g): %.3g points beside %.3g, rms %.3f dB, worst bin %.3f dB\n", of.sigma, of.tau,
                    1 / (of.step * static_cast<double>(of.kept)),
                    1 / (of.step * static_cast<double>(of.finer)), std::sqrt(squares), worst);
        CHECK(worst < 0.2);
    }
}

TEST_CASE("conductor patch: the first order in the heights is perturbation theory, cross-polarised too") {
    const double sigma = 0.005;
    const RandomField field = random_field({sigma, 0.6}, 1.0 / 6, 54, 11);
    const PlaneWaveBeam beam{40 * degree, 0.2, 1.5, 11.25};
    std::vector<Direction> out;
    for (int i = 0; i < 7; ++i) {
        for (int j = 0; j < 12; ++j)
            out.push_back(Direction::from_angles((5 + 10 * i) * degree, (15 + 30 * j) * degree));
    }
    // half the difference of a surface and its negative has no even orders
    const auto above = far(ConductorPatch{field}, beam, out, 1e-6),
               below = far(ConductorPatch{scaled(field, -1)}, beam, out, 1e-6);
    struct Channel {
        const char* name;
        Complex product = 0;
        double own = 0, other = 0;

        void add(Complex first_order, Complex exact) {
            product += std::conj(first_order) * exact;
            own += std::norm(first_order);
            other += std::norm(exact);
        }
    };
    std::array<Channel, 4> channels{{{"ss"}, {"sp"}, {"ps"}, {"pp"}}};
    const double step = field.step, middle = (static_cast<double>(field.samples) - 1) / 2;
    for (std::size_t i = 0; i < out.size(); ++i) {
        JonesMatrix sum{};
        for (const BeamWave& wave : beam.waves()) {
            const Direction in = wave.in();
            const Vector3 change = out[i].vector() - wave.along;
            Complex spectrum = 0;
            for (std::size_t y = 0; y < field.samples; ++y) {
                Complex row = 0;
                for (std::size_t x = 0; x < field.samples; ++x)
                    row += field.height[y * field.samples + x] *
                           std::polar(1.0, -k * change.x * step * (static_cast<double>(x) - middle));
                spectrum += row * std::polar(1.0, -k * change.y * step * (static_cast<double>(y) - middle));
            }
            const Complex amplitude =
                wave.amplitude * k * k * in.cos_theta() * out[i].cos_theta() / pi * spectrum * step * step;
            const JonesMatrix b = bragg_jones(in, out[i], perfect_conductor(), 0);
            sum.ss += amplitude * b.ss;
            sum.sp += amplitude * b.sp;
            sum.ps += amplitude * b.ps;
            sum.pp += amplitude * b.pp;
        }
        const auto odd = [&](std::size_t state, bool s) {
            const auto &a = above[state][i], &b = below[state][i];
            return Complex{s ? a.s - b.s : a.p - b.p} / 2.0;
        };
        channels[0].add(sum.ss, odd(0, true));
        channels[1].add(sum.sp, odd(1, true));
        channels[2].add(sum.ps, odd(0, false));
        channels[3].add(sum.pp, odd(1, false));
    }
    const Complex phase = channels[0].product / std::abs(channels[0].product);
    for (const Channel& each : channels) {
        const Complex ratio = each.product / each.own;
        const double rest = std::sqrt(std::max(0.0, 1 - std::norm(each.product) / (each.own * each.other)));
        std::printf("%s: exact/first order %.4f %+.4fi, apart %.4f, power %.3f dB\n", each.name, ratio.real(),
                    ratio.imag(), rest, 10 * std::log10(each.other / each.own));
        CHECK(std::abs(ratio - phase) < 0.02);
        CHECK(rest < 0.1);  // the edges of so small a patch
        CHECK(std::fabs(10 * std::log10(each.other / each.own)) < 0.1);
    }
}

TEST_CASE("conductor patch: a surface that varies along one axis scatters as its profile does") {
    constexpr std::size_t side = 72;
    constexpr double step = 1.0 / 8, length = step * side;
    const RandomProfile profile = random_profile({0.2, 0.8}, step, side, 21);
    RandomField field{step, side, {}, {}, std::vector<double>(side * side)};
    for (std::size_t j = 0; j < side; ++j) {
        field.height.insert(field.height.end(), profile.height.begin(), profile.height.end());
        field.slope_x.insert(field.slope_x.end(), profile.slope.begin(), profile.slope.end());
    }
    const double period = 1.25 * length;
    const PlaneWaveBeam beam{35 * degree, 0, length / 6, period};
    Contour contour{step,
                    {},
                    profile.height,
                    std::vector<double>(side, 1),
                    profile.slope,
                    std::vector<double>(side, 0),
                    profile.second_derivative};
    std::vector<double> angles;
    std::vector<Direction> out;
    for (int angle = -75; angle <= 75; angle += 5) {
        angles.push_back(angle * degree);
        out.push_back(Direction::from_angles(std::abs(angle) * degree, angle < 0 ? pi : 0));
    }
    // over all y, of the waves only those along the plane of incidence are left
    SurfaceField incident;
    for (std::size_t i = 0; i < side; ++i) {
        contour.x.push_back(step * (static_cast<double>(i) - (side - 1) / 2.0));
        Complex sum = 0;
        for (const BeamWave& wave : beam.waves()) {
            if (std::fabs(wave.along.y) > 1e-9) continue;
            sum -= period * std::polar(wave.amplitude, k * (wave.along.x * contour.x.back() +
                                                            wave.along.z * profile.height[i]));
        }
        incident.push_back(sum);
    }
    const PolarisedFields fields = surface_fields(contour, k, {&incident, 1});
    const FarField plane{contour, k, angles};
    const auto te = plane.amplitudes(fields.te)[0], tm = plane.amplitudes(fields.tm)[0];
    const auto amplitudes = far(ConductorPatch{field}, beam, out);
    for (const bool s : {true, false}) {
        double difference = 0, sum = 0, all = 0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            // behind the normal the frame of the reflected ray is turned round
            const double side_of = angles[i] < 0 ? -1 : 1;
            const Complex exact = side_of * (s ? te[i] : tm[i]) / (4 * pi);
            const Complex own{s ? amplitudes[0][i].s : amplitudes[1][i].p};
            difference += std::norm(own - exact);
            sum += std::norm(exact);
            all += std::norm(own);
        }
        std::printf("%s against the profile: field %.4f apart, power %.4f dB\n", s ? "s" : "p",
                    std::sqrt(difference / sum), 10 * std::log10(all / sum));
        CHECK(std::sqrt(difference / sum) < 0.003);
        CHECK(std::fabs(10 * std::log10(all / sum)) < 0.01);
    }
}
