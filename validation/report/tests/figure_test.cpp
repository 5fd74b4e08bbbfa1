#include "validation/report/figure.hpp"

#include <catch2/catch.hpp>

TEST_CASE("a page label is text, whatever stands in it") {
    CHECK(hts::validation::page_label("Young's fringes", 0.5, 0.25, 13) ==
          "set label 'Young''s fringes' at screen 0.5,0.25 left noenhanced font ',13' tc rgb '#111111'\n");
}
