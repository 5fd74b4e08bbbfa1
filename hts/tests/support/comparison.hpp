/// What every accuracy test shares: one error metric, the worst case, reference tables and random inputs.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "hts/sampling/random.hpp"

namespace hts::testing {

/// |computed - expected| / |expected|. Equal values, infinities included, give 0; NaN, an infinity on one
/// side only, and anything but 0 where 0 is expected give infinity.
[[nodiscard]] inline double relative_error(double computed, double expected) {
    if (computed == expected) return 0;
    const double error = std::abs(computed - expected) / std::abs(expected);
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// Collects errors, keeps the worst and where it was; `check` prints it and asserts the bound.
class WorstCase {
  public:
    WorstCase(std::string what, double bound) : what_{std::move(what)}, bound_{bound} {}

    void note(double error, const std::function<std::string()>& where) {
        ++count_;
        if (count_ == 1 || error > worst_ || std::isnan(error)) {
            worst_ = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
            where_ = where();
        }
    }
    /// Prints "phi: worst 2.7e-13 of 600, bound 1e-12, at g = …" and requires worst <= bound and at least one
    /// case.
    void check() const;
    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    std::string what_;
    double bound_;
    double worst_ = 0;
    std::string where_;
    std::size_t count_ = 0;
};

/// Columns of a reference file, its path from hts/, `#` lines passed over.
class ReferenceTable {
  public:
    explicit ReferenceTable(const std::string& file);

    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] double operator()(std::size_t row, const std::string& column) const {
        return rows_[row][columns_.at(column)];
    }
    /// "g = 3, t = 4": the named columns of a row.
    [[nodiscard]] std::string describe(std::size_t row, const std::vector<std::string>& columns) const;

  private:
    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<double>> rows_;
};

using hts::Random;

/// The value of an environment variable read as "run the long version": set and not "0".
[[nodiscard]] bool exhaustive();

}  // namespace hts::testing
