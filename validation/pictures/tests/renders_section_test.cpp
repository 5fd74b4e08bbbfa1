#include "validation/pictures/renders_section.hpp"

#include <catch2/catch.hpp>

using namespace hts::validation;

TEST_CASE("the pictures show what the text of He et al. 1991 says", "[.exhaustive]") {
    const Section section = renders_section(Effort::quick);
    CHECK(section.images.size() == 10);
    for (const Image& image : section.images) CHECK(image.png.starts_with("\x89PNG"));
    CHECK(section.checks.size() == 5);
    for (const Check& check : section.checks) {
        UNSCOPED_INFO(check.claim << ": " << check.measured);
        CHECK(check.passed);
    }
}
