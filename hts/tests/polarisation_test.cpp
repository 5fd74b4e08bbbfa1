#include "hts/polarisation.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/terms.hpp"

using hts::cross;
using hts::Direction;
using hts::dot;
using hts::facet_jones;
using hts::FresnelAmplitudes;
using hts::JonesMatrix;
using hts::JonesVector;
using hts::Mueller;
using hts::Stokes;
using hts::Vector3;
using hts::testing::Random;
using Complex = std::complex<double>;

namespace {

Direction random_direction(Random& random) {
    return Direction::from_degrees(random.uniform(0.1, 89.9), random.uniform(0, 360));
}

FresnelAmplitudes gold(const Direction& in, const Direction& out) {
    return hts::fresnel(wave_vector_change(in, out).cos_theta_d(), {0.183, 3.43});
}

void check_elements(const Mueller& computed, const double (&expected)[4][4]) {
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            INFO("element " << i << j);
            CHECK(computed(i, j) == Approx(expected[i][j]).margin(1e-6));
        }
    }
}

Mueller with_s2_and_s3_reversed(const Mueller& m) {
    std::array<double, 16> elements = m.elements();
    for (std::size_t e = 0; e < 16; ++e) {
        if ((e / 4 < 2) != (e % 4 < 2)) elements[e] = -elements[e];
    }
    return Mueller::from_elements(elements);
}

Mueller normalised_facet(const Direction& in, const Direction& out) {
    const Mueller m = Mueller::from_jones(facet_jones(in, out, gold(in, out)));
    return (1 / m(0, 0)) * m;
}

}  // namespace

TEST_CASE("a Mueller matrix does to Stokes vectors what its Jones matrix does to fields") {
    Random random{11};
    const auto complex = [&] { return Complex{random.uniform(-1, 1), random.uniform(-1, 1)}; };
    for (int i = 0; i < 200; ++i) {
        const JonesMatrix jones{complex(), complex(), complex(), complex()};
        const JonesVector field{complex(), complex()};
        const Stokes direct = Stokes::from_jones(
            {jones.ss * field.s + jones.sp * field.p, jones.ps * field.s + jones.pp * field.p});
        const Stokes through = Mueller::from_jones(jones) * Stokes::from_jones(field);
        for (std::size_t k = 0; k < 4; ++k) CHECK(through[k] == Approx(direct[k]).margin(1e-14));
    }
}

TEST_CASE("the facet's Jones matrix is that of the paper but for a sign") {
    Random random{12};
    for (int i = 0; i < 500; ++i) {
        const Direction in = random_direction(random);
        const Direction out = random_direction(random);
        const Vector3 ki = -in.vector();
        const Vector3 kr = out.vector();
        const auto unit = [](Vector3 v) { return (1 / std::sqrt(dot(v, v))) * v; };
        const Vector3 si = unit(cross(ki, {0, 0, 1}));
        const Vector3 sr = unit(cross(kr, {0, 0, 1}));
        const Vector3 pi = cross(si, ki);
        const Vector3 pr = cross(sr, kr);
        const auto f = gold(in, out);
        const Vector3 normal = cross(kr, ki);
        const double scale = -1 / dot(normal, normal);
        // [He91 (61)-(64)]
        const Complex ss = scale * (f.s * dot(pi, kr) * dot(pr, ki) + f.p * dot(si, kr) * dot(sr, ki));
        const Complex sp = -scale * (f.s * dot(si, kr) * dot(pr, ki) - f.p * dot(pi, kr) * dot(sr, ki));
        const Complex ps = -scale * (f.s * dot(pi, kr) * dot(sr, ki) - f.p * dot(si, kr) * dot(pr, ki));
        const Complex pp = scale * (f.s * dot(si, kr) * dot(sr, ki) + f.p * dot(pi, kr) * dot(pr, ki));
        const JonesMatrix ours = facet_jones(in, out, f);
        CHECK(std::abs(ours.ss - ss) < 1e-11);
        CHECK(std::abs(ours.sp - sp) < 1e-11);
        CHECK(std::abs(ours.ps - ps) < 1e-11);
        CHECK(std::abs(ours.pp - pp) < 1e-11);
        const double average =
            (std::norm(ours.ss) + std::norm(ours.sp) + std::norm(ours.ps) + std::norm(ours.pp)) / 2;
        CHECK(average == Approx(f.unpolarised_reflectance()).epsilon(1e-14));
    }
}

TEST_CASE("the gold facets computed with SCATMECH") {
    // normalised Mueller matrices, n = 0.183, k = 3.43, computed with NIST SCATMECH. Its frames have s = z x
    // k, the opposite of ours, and its S3 the opposite sign, so that S2 and S3 change sign together
    const Mueller mirror = normalised_facet(Direction::from_degrees(60, 0), Direction::from_degrees(60, 180));
    const double at_60[4][4] = {
        {1, 0.035982, 0, 0}, {0.035982, 1, 0, 0}, {0, 0, -0.695831, 0.717304}, {0, 0, -0.717304, -0.695831}};
    check_elements(mirror, at_60);

    const Direction in = Direction::from_degrees(45, 0);
    const Direction out = Direction::from_degrees(45, 180 + 30);
    const Mueller skew = with_s2_and_s3_reversed(normalised_facet(in, out));
    const double psps[4][4] = {{1, 0.013551, -0.011992, 0},
                               {0.013551, 0.149902, -0.960620, 0.233657},
                               {-0.011992, -0.960620, -0.085510, 0.264034},
                               {0, -0.233657, -0.264034, -0.935608}};
    check_elements(skew, psps);
}

TEST_CASE("the specular Mueller matrix is that of the facet in the mirror direction") {
    const hts::Surface smooth{0, 1};
    const auto wavelength = hts::Wavelength::from_micrometres(0.5);
    const hts::RefractiveIndex index{0.183, 3.43};
    for (const double theta : {0.0, 20.0, 60.0, 89.0}) {
        const Direction in = Direction::from_degrees(theta, 70);
        const Mueller specular = hts::specular_mueller(smooth, view(smooth, in), wavelength, index);
        const Mueller facet =
            Mueller::from_jones(facet_jones(in, in.mirror(), hts::fresnel(in.cos_theta(), index)));
        for (std::size_t e = 0; e < 16; ++e) {
            CHECK(specular.elements()[e] == Approx(facet.elements()[e]).margin(1e-14));
        }
    }
}

TEST_CASE("backscatter and normal incidence are limits") {
    // towards exact backscatter, also along the normal: the matrices converge to that of the limit
    for (const double theta : {0.0, 1e-9, 30.0, 89.0}) {
        const Direction in = Direction::from_degrees(theta, 25);
        const Mueller exact = normalised_facet(in, in);
        for (const double offset : {1e-4, 1e-6, 1e-8, 1e-10, 1e-14}) {
            const Mueller near = normalised_facet(in, Direction::from_degrees(theta + offset, 25));
            for (std::size_t e = 0; e < 16; ++e) {
                INFO("theta " << theta << ", offset " << offset << ", element " << e);
                CHECK(near.elements()[e] == Approx(exact.elements()[e]).margin(1e-13 + 1e-3 * offset));
            }
        }
    }
    const Direction normal = Direction::from_degrees(0, 40);
    const Mueller at_normal = normalised_facet(normal, Direction::from_degrees(0, 220));
    const Mueller near_normal =
        normalised_facet(Direction::from_degrees(1e-7, 40), Direction::from_degrees(1e-7, 220));
    for (std::size_t e = 0; e < 16; ++e) {
        CHECK(at_normal.elements()[e] == Approx(near_normal.elements()[e]).margin(1e-12));
    }
}

TEST_CASE("reciprocity of the polarised reflection") {
    // swapping the rays transposes the Jones matrix, but for the sign that the s and p of reversed rays take
    Random random{13};
    for (int i = 0; i < 200; ++i) {
        const Direction in = random_direction(random);
        const Direction out = random_direction(random);
        const JonesMatrix there = facet_jones(in, out, gold(in, out));
        const JonesMatrix back = facet_jones(out, in, gold(out, in));
        CHECK(std::abs(there.ss - back.ss) < 1e-13);
        CHECK(std::abs(there.pp - back.pp) < 1e-13);
        CHECK(std::abs(there.sp + back.ps) < 1e-13);
        CHECK(std::abs(there.ps + back.sp) < 1e-13);
    }
}

TEST_CASE("states of polarisation") {
    CHECK(Stokes::unpolarised().degree_of_polarisation() == 0);
    CHECK(Stokes::s_polarised().angle_of_polarisation() == 0);
    CHECK(Stokes::p_polarised().angle_of_polarisation() == Approx(std::acos(0.0)));
    const Stokes diagonal = Stokes::from_jones({1.0, 1.0});
    CHECK(diagonal[2] == 2);
    CHECK(diagonal.angle_of_polarisation() == Approx(std::atan(1.0)));
    const Stokes circular = Stokes::from_jones({1.0, Complex{0, 1}});
    CHECK(circular[3] == 2);
    CHECK(circular.degree_of_polarisation() == 1);
    CHECK((Mueller::depolariser(0.3) * circular).intensity() == Approx(0.6));
    CHECK((Mueller::depolariser(0.3) * circular).degree_of_polarisation() == 0);
    CHECK_THROWS_WITH(Stokes(-1, 0, 0, 0), "Stokes parameter s0 -1: must be >= 0 and finite");
    CHECK_THROWS_WITH(Stokes(1, 1, 1, 0), "polarised intensity 1.4142135623730951: must be at most s0 = 1");
    CHECK_THROWS_AS(Stokes(1, std::numeric_limits<double>::quiet_NaN(), 0, 0), hts::Error);
}
