#include "tables/formats/mitsuba/frames.hpp"

#include <cmath>

namespace hts {
namespace {

/// Takes a Stokes vector of our frame to the right-handed frame with the given x axis: S2 changes sign, then
/// the axes turn by the angle from s to x about k.
class FrameChange {
  public:
    FrameChange(Vector3 s, Vector3 k, Vector3 x) noexcept {
        const double cosine = dot(s, x);
        const double sine = dot(cross(k, s), x);
        cos_two_ = cosine * cosine - sine * sine;
        sin_two_ = 2 * cosine * sine;
    }

    /// Both columns 1 and 2 of a row, or both rows of a column.
    [[nodiscard]] std::array<double, 2> operator()(double s1, double s2) const noexcept {
        return {cos_two_ * s1 - sin_two_ * s2, -sin_two_ * s1 - cos_two_ * s2};
    }

  private:
    double cos_two_, sin_two_;
};

}  // namespace

Mueller in_right_handed_frames(const Mueller& mueller, const Direction& in, const Direction& out,
                               Vector3 x_in, Vector3 x_out) noexcept {
    const FrameChange incident{s_vector_of_incident(in), -in.vector(), x_in};
    const FrameChange reflected{s_vector_of_reflected(out), out.vector(), x_out};
    std::array<double, 16> m = mueller.elements();
    for (std::size_t row = 0; row < 4; ++row) {
        const auto turned = incident(m[4 * row + 1], m[4 * row + 2]);
        m[4 * row + 1] = turned[0];
        m[4 * row + 2] = turned[1];
    }
    for (std::size_t column = 0; column < 4; ++column) {
        const auto turned = reflected(m[4 + column], m[8 + column]);
        m[4 + column] = turned[0];
        m[8 + column] = turned[1];
    }
    return Mueller::from_elements(m);
}

Vector3 mitsuba_x_axis(Vector3 k) noexcept {
    const double sign = std::copysign(1.0, k.z);
    const double a = -1 / (sign + k.z);
    return {1 + sign * k.x * k.x * a, sign * k.x * k.y * a, -sign * k.x};
}

Mueller mitsuba_mueller(const Mueller& mueller, const Direction& in, const Direction& out) noexcept {
    return in_right_handed_frames(mueller, in, out, mitsuba_x_axis(-in.vector()),
                                  mitsuba_x_axis(out.vector()));
}

}  // namespace hts
