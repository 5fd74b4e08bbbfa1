#include "pairs.hpp"

#include "hts/error.hpp"

namespace hts::python {
namespace {

/// What places hold before they are written.
Direction any_direction() {
    return Direction::from_unit_vector({0, 0, 1});
}

}  // namespace

Direction direction(double theta, double phi, bool degrees) {
    return degrees ? Direction::from_degrees(theta, phi) : Direction::from_angles(theta, phi);
}

Pairs::Pairs(std::span<const Operand> angles, std::span<const Operand> vectors, const Broadcast& broadcast,
             bool degrees)
    : degrees_{degrees}, vectors_{!vectors.empty()} {
    for (const Operand& operand : angles) add(operand, 0, broadcast);
    for (const Operand& operand : vectors) {
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
            add(operand, axis * operand.component_stride(), broadcast);
    }
}

void Pairs::add(const Operand& operand, std::ptrdiff_t offset, const Broadcast& broadcast) {
    data_.push_back(operand.data() + offset);
    steps_.push_back(broadcast.steps(operand));
}

std::span<const DirectionPair> Pairs::of_block(const Walk& walk, std::size_t& element,
                                               std::size_t number) const {
    thread_local Columns columns;
    thread_local std::vector<DirectionPair> pairs(most, {any_direction(), any_direction()});
    for (std::size_t column = 0; column < data_.size(); ++column)
        walk.values(element, steps_[column], data_[column], std::span{columns[column]}.first(number));
    const std::span<DirectionPair> result = std::span{pairs}.first(number);
    if (degrees_ && !vectors_ && from_degrees(columns, result)) return result;
    for (std::size_t i = 0; i < number; ++i, ++element) result[i] = pair(columns, i);
    return result;
}

DirectionPair Pairs::pair(const Columns& of, std::size_t i) const {
    if (vectors_) {
        const Direction in = Direction::from_vector({of[0][i], of[1][i], of[2][i]});
        if (data_.size() == 3) return {in, in};
        return {in, Direction::from_vector({of[3][i], of[4][i], of[5][i]})};
    }
    const Direction in = direction(of[0][i], of[1][i], degrees_);
    if (data_.size() == 2) return {in, in};
    return {in, direction(of[2][i], of[1][i] + of[3][i], degrees_)};
}

bool Pairs::from_degrees(Columns& of, std::span<DirectionPair> pairs) const {
    thread_local std::vector<Direction> in(most, any_direction()), out = in;
    const std::size_t number = pairs.size();
    const auto read = [number](const Numbers& theta, const Numbers& phi, std::vector<Direction>& to) {
        Direction::from_degrees(std::span{theta}.first(number), std::span{phi}.first(number),
                                std::span{to}.first(number));
    };
    const bool views = data_.size() > 2;
    try {
        read(of[0], of[1], in);
        for (std::size_t i = 0; views && i < number; ++i) of[4][i] = of[1][i] + of[3][i];
        if (views) read(of[2], of[4], out);
    } catch (const Error&) {
        return false;
    }
    const std::vector<Direction>& second = views ? out : in;
    for (std::size_t i = 0; i < number; ++i) pairs[i] = {in[i], second[i]};
    return true;
}

}  // namespace hts::python
