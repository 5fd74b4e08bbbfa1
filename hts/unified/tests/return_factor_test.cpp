#include "hts/unified/return_factor.hpp"

#include <array>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::Direction;
using hts::ReturnFactor;
using hts::testing::WorstCase;

TEST_CASE("the return factor has the values of a converged solution by another program") {
    constexpr std::array degrees{0, 15, 30, 45, 60, 70, 75, 80, 85, 88};
    struct Row {
        double slope;
        std::array<double, 10> m;
    };
    // an independent solution of the same equation, four digits
    const std::vector<Row> rows{
        {0.10, {1.0001, 1.0002, 0.9996, 0.9978, 1.0115, 1.0452, 1.0622, 1.0640, 1.0342, 0.9963}},
        {0.15, {0.9973, 0.9959, 0.9965, 1.0125, 1.0513, 1.0709, 1.0674, 1.0491, 1.0129, 0.9821}},
        {0.20, {0.9819, 0.9889, 1.0115, 1.0482, 1.0785, 1.0730, 1.0576, 1.0323, 0.9967, 0.9704}},
        {0.25, {1.0012, 1.0142, 1.0470, 1.0815, 1.0878, 1.0641, 1.0429, 1.0154, 0.9815, 0.9582}},
        {0.30, {1.0810, 1.0877, 1.1028, 1.1079, 1.0814, 1.0438, 1.0192, 0.9908, 0.9587, 0.9375}},
        {0.35, {1.2163, 1.2072, 1.1811, 1.1343, 1.0666, 1.0132, 0.9844, 0.9541, 0.9221, 0.9019}},
        {0.40, {1.3956, 1.3648, 1.2816, 1.1679, 1.0516, 0.9788, 0.9437, 0.9093, 0.8751, 0.8545}},
        {0.50, {1.8411, 1.7570, 1.5359, 1.2692, 1.0425, 0.9226, 0.8707, 0.8232, 0.7795, 0.7549}},
        {0.70, {2.8719, 2.6732, 2.1710, 1.6041, 1.1316, 0.8996, 0.8067, 0.7268, 0.6582, 0.6217}},
        {1.00, {4.4679, 4.1123, 3.2902, 2.3399, 1.4563, 1.0093, 0.8393, 0.7015, 0.5909, 0.5354}}};
    WorstCase worst{"return factor", hts::accuracy::return_factor};
    for (const Row& row : rows) {
        const ReturnFactor m{row.slope};
        for (std::size_t i = 0; i < degrees.size(); ++i) {
            const double found = m(Direction::from_degrees(degrees[i], 0));
            worst.note(std::abs(found / row.m[i] - 1), [&] {
                std::ostringstream text;
                text << "sigma0/tau " << row.slope << ", theta " << degrees[i];
                return text.str();
            });
        }
    }
    worst.check();
    CHECK(ReturnFactor{0}(Direction::from_degrees(70, 0)) == Approx(1).margin(2e-4));
    CHECK(ReturnFactor{0}(Direction::from_degrees(90, 0)) == Approx(1).margin(2e-4));
    CHECK(ReturnFactor{3}(Direction::from_degrees(40, 0)) == ReturnFactor{1}(Direction::from_degrees(40, 0)));
}

TEST_CASE("what comes back after many reflections lies between a single one and the flat surface") {
    for (const double slope : {0.0, 0.1, 0.3, 0.7, 1.0}) {
        const ReturnFactor m{slope};
        CHECK(m.single_reflection() > 0.05);
        CHECK(m.single_reflection() <= 1);
        CHECK(m.returned(1) == Approx(1));
        CHECK(m.returned(0) == 0);
        CHECK(m.returned(0.5) <= 0.5);
        CHECK(m.returned(0.5) >= 0.5 * m.single_reflection());
    }
    CHECK(ReturnFactor{0}.single_reflection() == Approx(1).margin(1e-5));
}
