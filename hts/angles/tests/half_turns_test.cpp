#include "hts/angles/half_turns.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <vector>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/direction.hpp"
#include "targets.hpp"

using hts::Direction;
using hts::testing::Random;

namespace {

using Exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Angles as people write them, and random ones, spread logarithmically about 0 too.
std::vector<double> degrees(int count, double most) {
    std::vector<double> all;
    for (int i = 0; i <= 40 * static_cast<int>(most); ++i) all.push_back(i / 40.0);
    for (int i = 0; i <= 3 * static_cast<int>(most); ++i) all.push_back(i / 3.0);
    Random random{7};
    for (int i = 0; i < count; ++i) {
        all.push_back(random.uniform(0, most));
        all.push_back(most * std::exp(-random.uniform(0, 80)));
    }
    std::erase_if(all, [&](double angle) { return angle > most; });
    return all;
}

double relative(double value, const Exact& exact) {
    return exact == 0 ? std::fabs(value) : std::fabs(Exact{value / exact - 1}.convert_to<double>());
}

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

TEST_CASE("sines and cosines of half turns are within the bound") {
    const Exact pi = boost::math::constants::pi<Exact>();
    double worst = 0, where = 0;
    for (const double size : degrees(4000, 180)) {
        const double x = size / 180;
        const Exact sine = sin((x <= 0.5 ? Exact{x} : 1 - Exact{x}) * pi);
        CHECK(hts::sin_half_turns(x) == hts::half_turns(x).sine);
        const double error = std::max(relative(hts::half_turns(x).sine, sine),
                                      relative(hts::half_turns(x).cosine, sin((0.5 - Exact{x}) * pi)));
        if (error > worst) {
            worst = error;
            where = x;
        }
    }
    std::cout << "half turns: worst " << worst << " at " << where << '\n';
    CHECK(worst <= hts::accuracy::half_turns);
}

TEST_CASE("degrees become sines and cosines within the bound") {
    const Exact degree = boost::math::constants::degree<Exact>();
    double worst_polar = 0, worst_azimuth = 0, theta = 0, phi = 0;
    for (const double angle : degrees(4000, 90)) {
        const Direction direction = Direction::from_degrees(angle, 0);
        const double error = std::max(relative(direction.sin_theta(), sin(angle * degree)),
                                      relative(direction.cos_theta(), sin((90 - Exact{angle}) * degree)));
        if (error > worst_polar) {
            worst_polar = error;
            theta = angle;
        }
    }
    for (const double size : degrees(4000, 720)) {
        for (const double angle : {size, -size}) {
            const Direction direction = Direction::from_degrees(0, angle);
            const double error =
                std::max(std::fabs(Exact{direction.sin_phi() - sin(angle * degree)}.convert_to<double>()),
                         std::fabs(Exact{direction.cos_phi() - cos(angle * degree)}.convert_to<double>()));
            if (error > worst_azimuth) {
                worst_azimuth = error;
                phi = angle;
            }
        }
    }
    std::cout << "from_degrees: worst " << worst_polar << " relative at theta " << theta << ", "
              << worst_azimuth << " at phi " << phi << '\n';
    CHECK(worst_polar <= hts::accuracy::polar_angle_from_degrees);
    CHECK(worst_azimuth <= hts::accuracy::azimuth_from_degrees);
}

TEST_CASE("degrees become the doubles that Boost's long doubles round to, zeros with their signs") {
    using boost::math::cos_pi;
    using boost::math::sin_pi;
    int different = 0;
    for (const double size : degrees(100'000, 180)) {
        for (const double phi : {size, -size}) {
            const Direction direction = Direction::from_degrees(std::min(size, 90.0), phi);
            different += !same(direction.sin_phi(), sin_pi(phi / 180));
            different += !same(direction.cos_phi(), cos_pi(phi / 180));
            if (size > 90) continue;
            different += !same(direction.sin_theta(), sin_pi(size / 180));
            different +=
                !same(direction.cos_theta(), size < 45 ? cos_pi(size / 180) : sin_pi((90 - size) / 180));
        }
    }
    CHECK(different == 0);
}

TEST_CASE("many directions from degrees have the bits of each") {
    Random random{11};
    std::vector<double> theta, phi;
    const double odd[]{0.0,
                       -0.0,
                       5e-324,
                       1e-310,
                       1e-250,
                       1e-199,
                       1e-20,
                       180,
                       -180,
                       179.99999999999997,
                       360,
                       -360,
                       539.9999999999999,
                       540,
                       -540,
                       720,
                       1e5,
                       90,
                       -90,
                       45,
                       135,
                       -135,
                       30,
                       60,
                       270};
    for (const double a : odd) {
        for (const double b : odd) {
            theta.push_back(a >= 0 && a <= 90 ? a : 90 - 1e-13);
            phi.push_back(b);
        }
    }
    for (const double angle : degrees(100'000, 90)) {
        theta.push_back(angle);
        phi.push_back(random.uniform(-700, 700));
    }
    for (const double angle : degrees(100'000, 720)) {
        theta.push_back(random.uniform(0, 90));
        phi.push_back(random.uniform(0, 1) < 0.5 ? angle : -angle);
    }
    std::vector<Direction> one, all(theta.size(), Direction::from_degrees(0, 0));
    for (std::size_t i = 0; i < theta.size(); ++i) one.push_back(Direction::from_degrees(theta[i], phi[i]));
    hts::testing::on_every_target([&](const std::string& target) {
        Direction::from_degrees(theta, phi, all);
        std::size_t different = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool alike = same(all[i].cos_theta(), one[i].cos_theta()) &&
                               same(all[i].sin_theta(), one[i].sin_theta()) &&
                               same(all[i].cos_phi(), one[i].cos_phi()) &&
                               same(all[i].sin_phi(), one[i].sin_phi());
            if (!alike && different++ == 0)
                UNSCOPED_INFO(target << ": theta " << theta[i] << ", phi " << phi[i]);
        }
        CHECK(different == 0);
    });
}

TEST_CASE("of many directions from degrees the first that is wrong is named") {
    std::vector<Direction> all(300, Direction::from_degrees(0, 0));
    std::vector<double> theta(300, 30), phi(300, 20);
    theta[200] = 91;
    phi[250] = HUGE_VAL;
    CHECK_THROWS_WITH(Direction::from_degrees(theta, phi, all),
                      "polar angle 91 deg: must be from 0 to 90 deg");
    CHECK(all[199].cos_phi() == Direction::from_degrees(30, 20).cos_phi());
    theta[200] = 90;
    CHECK_THROWS_WITH(Direction::from_degrees(theta, phi, all), "azimuth inf deg: must be finite");
    theta[200] = NAN;
    CHECK_THROWS_WITH(Direction::from_degrees(theta, phi, all), Catch::Matchers::StartsWith("polar angle"));
    phi.pop_back();
    CHECK_THROWS_WITH(Direction::from_degrees(theta, phi, all), Catch::Matchers::EndsWith("must be as many"));
}
