#include "comparison.hpp"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>

namespace hts::testing {

void WorstCase::check() const {
    std::cout << what_ << ": worst " << worst_ << " of " << count_ << ", bound " << bound_ << ", at "
              << where_ << '\n';
    INFO(what_ << " at " << where_);
    CHECK(count_ > 0);
    CHECK(worst_ <= bound_);
}

ReferenceTable::ReferenceTable(const std::string& file) {
    std::ifstream in{std::string{HTS_SOURCE_DIR "/hts/"} + file};
    std::string line;
    while (std::getline(in, line)) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream cells{line};
        std::string cell;
        if (columns_.empty()) {
            while (std::getline(cells, cell, ',')) columns_.emplace(cell, columns_.size());
            continue;
        }
        rows_.emplace_back();
        while (std::getline(cells, cell, ',')) rows_.back().push_back(std::strtod(cell.c_str(), nullptr));
        REQUIRE(rows_.back().size() == columns_.size());
    }
    INFO(file);
    REQUIRE_FALSE(rows_.empty());
}

std::string ReferenceTable::describe(std::size_t row, const std::vector<std::string>& columns) const {
    std::ostringstream text;
    text.precision(17);
    for (const std::string& column : columns) {
        text << (text.tellp() > 0 ? ", " : "") << column << " = " << (*this)(row, column);
    }
    return text.str();
}

bool exhaustive() {
    const char* value = std::getenv("HTS_EXHAUSTIVE");
    return value != nullptr && std::string{value} != "0";
}

}  // namespace hts::testing
