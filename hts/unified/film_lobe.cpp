#include "hts/unified/film_lobe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace hts {
namespace {

constexpr std::size_t most_interfaces = 9;  // of which fields are tabled
constexpr std::size_t parts = 6;            // of Fields

JonesMatrix sum_of(const JonesMatrix& a, const std::complex<double>& of_a, const JonesMatrix& b,
                   const std::complex<double>& of_b) {
    return {of_a * a.ss + of_b * b.ss, of_a * a.sp + of_b * b.sp, of_a * a.ps + of_b * b.ps,
            of_a * a.pp + of_b * b.pp};
}

}  // namespace

JonesMatrix bragg_of_fields(const Direction& in, const Direction& out, const CoatedIndex& index,
                            std::span<const CoatedIndex::Fields> of_in,
                            std::span<const CoatedIndex::Fields> of_out) noexcept {
    const double cosine = -(in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi());
    const double sine = -sin_azimuth_between(in, out);
    const double sines = in.sin_theta() * out.sin_theta();
    JonesMatrix sum{};
    std::complex<double> above = 1;
    for (std::size_t j = 0; j < index.interfaces(); ++j) {
        const std::complex<double> below = index.square_below(j), step = below - above;
        const auto &i = of_in[j], &o = of_out[j];
        sum.ss -= cosine * step * i.s * o.s;
        sum.sp -= sine * step * i.p_electric * o.s;
        sum.ps -= sine * step * i.s * o.p_electric;
        sum.pp += step * (cosine * i.p_electric * o.p_electric - sines * i.p * o.p / (above * below));
        above = below;
    }
    return sum;
}

FilmPair::FilmPair(const DirectionPair& of) noexcept
    : in{of.in},
      out{of.out},
      s{facet_jones(of.in, of.out, {1.0, 0.0})},
      p{facet_jones(of.in, of.out, {0.0, 1.0})} {
    const WaveVectorChange change = wave_vector_change(of.in, of.out);
    cos_theta_d = change.cos_theta_d();
    kirchhoff = change.root_geometrical_factor() / 2;
    bragg = 2 * of.in.cos_theta() * of.out.cos_theta() / change.vertical;
}

FilmLobe::FilmLobe(const CoatedIndex& index, double lift) : amplitudes_{index}, lift_{lift} {
    if (index.interfaces() > most_interfaces) return;
    std::array<CoatedIndex::Fields, most_interfaces> fields;
    fields_ = CosineTable::made(
        parts * index.interfaces(),
        [&](double cosine, std::span<double> values) {
            index.fields(cosine, lift, fields);
            for (std::size_t j = 0; j < index.interfaces(); ++j) {
                const auto& at = fields[j];
                const std::array<double, parts> numbers{at.s.real(),          at.s.imag(),
                                                        at.p.real(),          at.p.imag(),
                                                        at.p_electric.real(), at.p_electric.imag()};
                std::ranges::copy(numbers, values.begin() + static_cast<std::ptrdiff_t>(parts * j));
            }
        },
        accuracy::tabled_films);
}

void FilmLobe::fields(double cosine, std::span<CoatedIndex::Fields> fields) const noexcept {
    if (!fields_) return amplitudes_.index().fields(cosine, lift_, fields);
    std::array<double, parts * most_interfaces> values;
    const std::size_t count = amplitudes_.index().interfaces();
    fields_->at(cosine, std::span{values}.first(parts * count));
    for (std::size_t j = 0; j < count; ++j) {
        const double* const v = values.data() + parts * j;
        fields[j] = {{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}};
    }
}

/// Bragg's matrix, with room for so many interfaces.
template <std::size_t room>
JonesMatrix FilmLobe::bragg(const FilmPair& pair) const noexcept {
    std::array<CoatedIndex::Fields, room> of_in, of_out;
    fields(pair.in.cos_theta(), of_in);
    fields(pair.out.cos_theta(), of_out);
    return bragg_of_fields(pair.in, pair.out, amplitudes_.index(), of_in, of_out);
}

JonesMatrix FilmLobe::operator()(const FilmPair& pair, double lobe, double share) const noexcept {
    const std::size_t interfaces = amplitudes_.index().interfaces();
    const JonesMatrix bragg = interfaces == 2 ? this->bragg<2>(pair)
                              : interfaces <= most_interfaces
                                  ? this->bragg<most_interfaces>(pair)
                                  : this->bragg<CoatedIndex::most_films + 1>(pair);
    const FresnelAmplitudes f = amplitudes_.amplitudes(pair.cos_theta_d);
    const JonesMatrix facet = sum_of(pair.s, f.s, pair.p, f.p);
    const double scale = std::sqrt(lobe);
    return sum_of(facet, scale * share * pair.kirchhoff, bragg, scale * (1 - share) * pair.bragg);
}

std::size_t FilmLobe::bytes() const noexcept {
    return sizeof *this + amplitudes_.bytes() - sizeof amplitudes_ + (fields_ ? fields_->bytes() : 0);
}

}  // namespace hts
