#include "tables/formats/radiance/tensor_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

constexpr double quarter = std::numbers::pi / 4;
constexpr int deepest = 24, most_halvings = 12;

using Position = std::array<double, 4>;  // in the unit cube; rank 3 leaves the last one out

// Shirley and Chiu: from the square to the direction above it.
Direction direction_of(double x, double y) {
    const double a = 2 * x - 1, b = 2 * y - 1;
    double r = 0, phi = 0;
    if (a > -b) {
        r = std::max(a, b);
        phi = a > b ? quarter * (b / a) : quarter * (2 - a / b);
    } else {
        r = std::max(-a, -b);
        if (a < b) {
            phi = quarter * (4 + b / a);
        } else if (b != 0) {
            phi = quarter * (6 - a / b);
        }
    }
    return Direction::from_unit_vector(
        {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - r * r))});
}

std::array<double, 2> square_of(double x, double y) noexcept {
    const double r = std::hypot(x, y);
    double phi = std::atan2(y, x);
    if (phi < -quarter) phi += 8 * quarter;
    double a = 0, b = 0;
    if (phi < quarter) {
        a = r;
        b = phi / quarter * r;
    } else if (phi < 3 * quarter) {
        b = r;
        a = (2 - phi / quarter) * r;
    } else if (phi < 5 * quarter) {
        a = -r;
        b = (4 - phi / quarter) * r;
    } else {
        b = -r;
        a = (phi / quarter - 6) * r;
    }
    return {(a + 1) / 2, (b + 1) / 2};
}

Position position_of(int rank, const DirectionPair& pair) noexcept {
    const Direction &in = pair.in, &out = pair.out;
    if (rank == 4) {
        const auto light = square_of(-in.sin_theta() * in.cos_phi(), -in.sin_theta() * in.sin_phi());
        const auto view = square_of(out.sin_theta() * out.cos_phi(), out.sin_theta() * out.sin_phi());
        return {light[0], light[1], view[0], view[1]};
    }
    const double x = -out.sin_theta() * (out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi());
    const double y = -out.sin_theta() * (out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi());
    const auto view = square_of(x, y);
    // as Radiance takes it, by 1e-6 less: light along the normal belongs to the lower half, light on the
    // border of two cells to the one nearer to the horizon
    return {(0.5 - 1e-6) - in.sin_theta() / 2, view[0], view[1], 0};
}

DirectionPair pair_at(int rank, const Position& at) {
    if (rank == 4) return {direction_of(at[0], at[1]).mirror(), direction_of(at[2], at[3])};
    const double sine = 1 - 2 * at[0];
    return {Direction::from_unit_vector({-sine, 0, std::sqrt(1 - sine * sine)}), direction_of(at[1], at[2])};
}

// A part of the tree under construction.
struct Branch {
    double low, high;  // of its cells
    double mean;
    bool constant;
    std::string text;
};

class TreeWriter {
  public:
    TreeWriter(const spectral::Reflectance& brdf, int rank, const TensorTreeOptions& options)
        : rank_{rank},
          depth_{options.depth},
          merge_{options.merge},
          values_(std::size_t{1} << (rank * depth_)) {
        const std::size_t side = std::size_t{1} << depth_;
        const std::size_t used = rank == 3 ? values_.size() / 2 : values_.size();
        const auto fill = [&](std::size_t cell) {
            const std::size_t parts = std::size_t{1} << rank;
            for (std::size_t part = 0; part < parts; ++part) {
                Position at{};
                std::size_t rest = cell;
                for (int axis = rank; axis-- > 0; rest /= side) {
                    const double step = (part >> axis & 1) != 0 ? 0.75 : 0.25;
                    at[static_cast<std::size_t>(axis)] =
                        (static_cast<double>(rest % side) + step) / static_cast<double>(side);
                }
                double value = 0;
                brdf.brdf(pair_at(rank, at), {&value, 1});
                values_[cell] += value / static_cast<double>(parts);
            }
        };
        spectral::parallel_for(used, fill, 4096);
        peak_ = *std::max_element(values_.begin(), values_.end());
    }

    [[nodiscard]] std::string text() const {
        const Branch root = branch(0, {});
        return root.constant ? number(root.mean) : root.text;
    }

  private:
    using Cell = std::array<std::size_t, 4>;

    [[nodiscard]] static std::string number(double value) {
        std::string text{'{'};
        append_rounded(text, value);
        text += '}';
        return text;
    }
    // NOLINTNEXTLINE(misc-no-recursion): the depth is bounded
    [[nodiscard]] Branch branch(int level, const Cell& cell) const {
        if (level == depth_) {
            std::size_t place = 0;
            for (int axis = 0; axis < rank_; ++axis)
                place = (place << depth_) + cell[static_cast<std::size_t>(axis)];
            return {values_[place], values_[place], values_[place], true, {}};
        }
        std::vector<Branch> children;
        for (std::size_t child = 0; child < std::size_t{1} << rank_; ++child) {
            Cell part{};
            for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank_); ++axis)
                part[axis] = 2 * cell[axis] + (child >> axis & 1);
            children.push_back(branch(level + 1, part));
        }
        return joined(children, level + 1 == depth_);
    }
    // Children stand with the first dimension fastest, the numbers of a leaf with the last.
    [[nodiscard]] Branch joined(const std::vector<Branch>& children, bool leaf) const {
        Branch all{children.front().low, 0, 0, true, {}};
        for (const Branch& child : children) {
            all.low = std::min(all.low, child.low);
            all.high = std::max(all.high, child.high);
            all.mean += child.mean / static_cast<double>(children.size());
        }
        all.constant = all.high - all.low <= merge_ * (all.high + 1e-3 * peak_);
        if (all.constant) return all;
        all.text += '{';
        for (std::size_t i = 0; i < children.size(); ++i) {
            if (leaf) {
                append_rounded(all.text, children[reversed(i)].mean);
                all.text += i + 1 < children.size() ? " " : "";
            } else {
                all.text += children[i].constant ? number(children[i].mean) : children[i].text;
            }
        }
        all.text += leaf ? "}" : "}\n";
        return all;
    }
    [[nodiscard]] std::size_t reversed(std::size_t child) const {
        std::size_t result = 0;
        for (int axis = 0; axis < rank_; ++axis) result |= (child >> axis & 1) << (rank_ - 1 - axis);
        return result;
    }

    int rank_, depth_;
    double merge_, peak_ = 0;
    std::vector<double> values_;  // of the finest cells, last dimension fastest
};

class TensorTree {
  public:
    TensorTree(int rank, Tokens& tokens) : rank_{rank} { root_ = take(tokens, 0); }

    [[nodiscard]] double operator()(Position at) const noexcept {
        std::size_t node = root_;
        while (nodes_[node].halvings < 0) {
            std::size_t child = 0;
            for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank_); ++axis) {
                const bool upper = at[axis] >= 0.5;
                child |= (upper ? std::size_t{1} : 0) << axis;
                at[axis] = 2 * at[axis] - (upper ? 1 : 0);
            }
            node = children_[nodes_[node].first + child];
        }
        const std::size_t side = std::size_t{1} << nodes_[node].halvings;
        std::size_t place = 0;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank_); ++axis) {
            const auto step = static_cast<std::size_t>(std::max(0.0, at[axis]) * static_cast<double>(side));
            place = place * side + std::min(step, side - 1);
        }
        return values_[nodes_[node].first + place];
    }

  private:
    struct Node {
        int halvings;       // of its values per dimension, -1 if it has children
        std::size_t first;  // of its values or children
    };

    // NOLINTNEXTLINE(misc-no-recursion): the depth is bounded
    std::size_t take(Tokens& tokens, int depth) {
        if (depth > deepest)
            throw tokens.error(
                std::to_string(depth).append(" levels: must be at most ").append(std::to_string(deepest)));
        tokens.take_word("{");
        const Node node = tokens.next() == "{" ? take_children(tokens, depth) : take_values(tokens);
        tokens.take_word("}");
        nodes_.push_back(node);
        return nodes_.size() - 1;
    }
    // NOLINTNEXTLINE(misc-no-recursion): the depth is bounded
    Node take_children(Tokens& tokens, int depth) {
        std::vector<std::size_t> children;
        for (std::size_t i = 0; i < std::size_t{1} << rank_; ++i) children.push_back(take(tokens, depth + 1));
        const std::size_t first = children_.size();
        children_.insert(children_.end(), children.begin(), children.end());
        return {-1, first};
    }
    Node take_values(Tokens& tokens) {
        const std::size_t first = values_.size();
        while (tokens.next() != "}") values_.push_back(tokens.take_value("BRDF"));
        const std::size_t count = values_.size() - first;
        int halvings = 0;
        while (halvings < most_halvings && std::size_t{1} << (halvings * rank_) < count) ++halvings;
        if (std::size_t{1} << (halvings * rank_) != count) {
            throw tokens.error(std::to_string(count) + " numbers in braces: must be a power of " +
                               std::to_string(1 << rank_));
        }
        return {halvings, first};
    }

    int rank_;
    std::size_t root_ = 0;
    std::vector<Node> nodes_;
    std::vector<std::size_t> children_;
    std::vector<double> values_;
};

class TensorTreeBrdf final : public spectral::Evaluator {
  public:
    TensorTreeBrdf(const std::string& name, const spectral::WavelengthGrid& wavelength, int rank,
                   Tokens& tokens)
        : spectral::Evaluator{name, wavelength}, rank_{rank}, tree_{rank, tokens} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool above = pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
        values[0] = above ? tree_(position_of(rank_, pair)) : 0;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        values[0] = 0;
    }

  private:
    int rank_;
    TensorTree tree_;
};

}  // namespace

std::string tensor_tree_text(const spectral::Reflectance& brdf, const TensorTreeOptions& options) {
    if (brdf.wavelengths().size() != 1) {
        throw out_of_range("number of wavelengths", static_cast<double>(brdf.wavelengths().size()), "",
                           "1 in a tensor tree");
    }
    const int rank = brdf.properties().isotropic ? 3 : 4, most = rank == 3 ? 8 : 6;
    TensorTreeOptions chosen = options;
    if (chosen.depth == 0) chosen.depth = most - 1;
    if (chosen.depth < 1 || chosen.depth > most) {
        throw out_of_range("depth of the tensor tree", chosen.depth, "", "from 1 to " + std::to_string(most));
    }
    if (!(chosen.merge >= 0 && chosen.merge <= 1))
        throw out_of_range("spread of merged cells", chosen.merge, "", "from 0 to 1");
    return TreeWriter{brdf, rank, chosen}.text();
}

spectral::Reflectance tensor_tree_brdf(const std::string& name, const spectral::WavelengthGrid& wavelength,
                                       int rank, Tokens& tokens) {
    if (wavelength.size() != 1)
        throw out_of_range("number of wavelengths", static_cast<double>(wavelength.size()), "", "1");
    return spectral::Reflectance{std::make_shared<const TensorTreeBrdf>(name, wavelength, rank, tokens)};
}

}  // namespace hts::tables
