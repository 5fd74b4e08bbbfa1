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
    const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
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
