#include "validation/curves/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "hts/error.hpp"
#include "spectral/models/reflectance.hpp"
#include "validation/curves/quadrature.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;

void require_nodes(const AveragingNodes& nodes) {
    const auto require = [](const char* quantity, int value, int least, int most) {
        if (value >= least && value <= most) return;
        throw out_of_range(quantity, value, "", std::to_string(least) + " ... " + std::to_string(most));
    };
    require("number of wavelengths per band", nodes.wavelengths, 1, 64);
    require("number of rings per cone", nodes.rings, 0, 8);
}

double half_angle(double solid_angle) {
    return 2 * std::asin(std::sqrt(solid_angle / (4 * pi)));
}

double angle_between(Vector3 a, Vector3 b) {
    const Vector3 chord = a - b;
    return 2 * std::asin(std::min(1.0, std::sqrt(dot(chord, chord)) / 2));
}

/// A direction and its share of a cone [sr, projected].
struct ConeNode {
    Direction direction;
    double weight;
};

/// Vectors that with `axis` are at right angles to each other.
std::pair<Vector3, Vector3> across(const Direction& axis) {
    const double c = axis.cos_theta(), x = axis.cos_phi(), y = axis.sin_phi();
    return {{c * x, c * y, -axis.sin_theta()}, {-y, x, 0}};
}

/// Rings at Gauss-Legendre nodes of the solid angle inside them, each turned against the one before.
std::vector<ConeNode> cone_nodes(const Direction& axis, double half_angle, int rings) {
    const GaussLegendre inside = gauss_legendre(rings);
    const auto [u, v] = across(axis);
    const double height = 2 * std::pow(std::sin(half_angle / 2), 2);
    const int around = 4 * rings;
    std::vector<ConeNode> nodes;
    for (std::size_t k = 0; k < inside.nodes.size(); ++k) {
        const double drop = inside.nodes[k] * height, sine = std::sqrt(drop * (2 - drop));
        for (int j = 0; j < around; ++j) {
            const double turn = 2 * pi * (j + (k % 2 == 0 ? 0.0 : 0.5)) / around;
            const Vector3 at =
                (1 - drop) * axis.vector() + sine * std::cos(turn) * u + sine * std::sin(turn) * v;
            if (at.z > 0)
                nodes.push_back(
                    {Direction::from_unit_vector(at), inside.weights[k] * 2 * pi * height / around * at.z});
        }
    }
    return nodes;
}

/// All directions above the horizon, in rings about the mirror direction of `in`, where lobes are: the rings
/// are the closer the nearer to it, and each is cut at the horizon.
std::vector<ConeNode> hemisphere_nodes(const Direction& in) {
    const GaussLegendre across_rings = gauss_legendre(24), along_ring = gauss_legendre(10);
    const Direction axis = in.mirror();
    const auto [u, v] = across(axis);
    const double c = axis.cos_theta(), s = axis.sin_theta();
    const double farthest = pi / 2 + std::atan2(s, c);
    std::vector<ConeNode> nodes;
    for (std::size_t k = 0; k < across_rings.nodes.size(); ++k) {
        const double part = across_rings.nodes[k], apart = farthest * part * part;
        const double ring = across_rings.weights[k] * 2 * farthest * part * std::sin(apart);
        // z = cos(apart) c - sin(apart) s cos(turn) > 0
        const double height = std::cos(apart) * c, dip = std::sin(apart) * s;
        const double first = height >= dip ? 0 : height <= -dip ? pi : std::acos(height / dip);
        for (std::size_t j = 0; j < along_ring.nodes.size(); ++j) {
            const double turn = first + (pi - first) * along_ring.nodes[j];
            for (const double side : {-1.0, 1.0}) {
                const Vector3 at = std::cos(apart) * axis.vector() +
                                   std::sin(apart) * (std::cos(turn) * u + side * std::sin(turn) * v);
                if (!(at.z > 0)) continue;
                nodes.push_back(
                    {Direction::from_unit_vector(at), ring * along_ring.weights[j] * (pi - first) * at.z});
            }
        }
    }
    return nodes;
}

double total(const std::vector<ConeNode>& nodes) {
    double sum = 0;
    for (const ConeNode& node : nodes) sum += node.weight;
    return sum;
}

/// The source's or the detector's cone about one direction.
struct Cone {
    Cone(const Direction& towards, const std::optional<double>& solid_angle, int rings)
        : axis{towards}, stated{solid_angle.has_value()}, half{stated ? half_angle(*solid_angle) : 0} {
        const bool whole = axis.cos_theta() >= std::sin(half);
        projected = pi * std::pow(std::sin(half), 2) * axis.cos_theta();
        if (!whole) projected = total(cone_nodes(axis, half, 8));
        if (stated && rings > 0) {
            nodes = cone_nodes(axis, half, rings);
        } else if (axis.cos_theta() > 0) {
            nodes = {{axis, axis.cos_theta()}};
        }
    }

    Direction axis;
    bool stated;
    double half;       // [rad]
    double projected;  // of what is above the horizon [sr]; 0 for a single direction
    std::vector<ConeNode> nodes;
};

/// The middle of the light that both the source's cone sends and the detector's mirrored cone takes, and its
/// amount over both projected solid angles [1/sr].
struct SpecularView {
    Direction incidence;
    double weight;
};

SpecularView specular_view(const Cone& source, const Cone& detector) {
    const Direction wanted = detector.axis.mirror();
    const double apart = angle_between(source.axis.vector(), wanted.vector());
    const double first = std::max(-source.half, apart - detector.half);
    const double last = std::min(source.half, apart + detector.half);
    if (last < first || (!source.stated && !detector.stated)) return {source.axis, 0};
    const double part = apart > 0 ? (first + last) / (2 * apart) : 0;
    Vector3 middle = (1 - part) * source.axis.vector() + part * wanted.vector();
    middle.z = std::max(middle.z, 0.0);
    const Direction incidence = Direction::from_vector(middle);
    if (!detector.stated) return {incidence, source.projected > 0 ? 1 / source.projected : 0};
    if (!source.stated) return {incidence, detector.projected > 0 ? 1 / detector.projected : 0};
    const double both = source.projected * detector.projected;
    const double common = common_solid_angle(source.half, detector.half, apart) * incidence.cos_theta();
    return {incidence, both > 0 ? common / both : 0};
}

double quantity_factor(Quantity quantity, const Direction& out) {
    switch (quantity) {
        case Quantity::brdf:
            return 1;
        case Quantity::brdf_cosine:
            return out.cos_theta();
        case Quantity::hemispherical_reflectance:
            return 1;
        case Quantity::reflectance_factor:
            break;
    }
    return pi;
}

Prediction::Job job_of(const Band& band, int wavelengths) {
    const GaussLegendre rule = gauss_legendre(band.single() ? 1 : wavelengths);
    std::vector<double> um;
    for (const double node : rule.nodes) um.push_back(band.first + node * (band.last - band.first));
    return {spectral::WavelengthGrid::from_micrometres(std::move(um)), rule.weights, {}, {}};
}

}  // namespace

double common_solid_angle(double a, double b, double apart) noexcept {
    const double smaller = std::min(a, b), larger = std::max(a, b);
    if (apart >= a + b || smaller <= 0) return 0;
    const double whole = 4 * pi * std::pow(std::sin(smaller / 2), 2);
    if (apart <= larger - smaller) return whole;
    // half the angles at the corners of the spherical triangle (axis, axis, crossing), from its sides
    const double s = (a + b + apart) / 2;
    const auto half_corner = [&](double opposite, double one, double other) {
        return std::atan2(std::sqrt(std::max(0.0, std::sin(s - one) * std::sin(s - other))),
                          std::sqrt(std::max(0.0, std::sin(s) * std::sin(s - opposite))));
    };
    const double at_a = 2 * half_corner(b, a, apart), at_b = 2 * half_corner(a, b, apart);
    const double crossing = 2 * half_corner(apart, a, b);
    // two sectors of the caps less the two triangles between them
    const double sectors =
        2 * at_a * 2 * std::pow(std::sin(a / 2), 2) + 2 * at_b * 2 * std::pow(std::sin(b / 2), 2);
    const double triangles = 2 * (at_a + at_b + crossing - pi);
    return std::clamp(sectors - triangles, 0.0, whole);
}

/// Fills a Prediction, row by row.
class Prediction::Builder {
  public:
    Builder(Prediction& result, AveragingNodes nodes) : result_{result}, nodes_{nodes} {}

    void add_all(std::span<const CurveSet> sets) {
        std::vector<Lights> lights;
        for (const CurveSet& set : sets) {
            lights.push_back({set, result_.rows_.size(), {}});
            for (const Curve& curve : set.curves) {
                for (const CurvePoint& point : curve.points) {
                    const DirectionPair pair = point.pair();
                    lights.back().of_points.emplace_back(curve.band, pair.in);
                    if (set.quantity == Quantity::hemispherical_reflectance)
                        add_hemisphere(curve.band, pair.in);
                    else
                        add(set, curve.band, pair);
                }
            }
        }
        result_.point_count_ = result_.rows_.size();
        for (const Lights& of_set : lights)
            if (of_set.set.scale == Scale::specular) add_mirrors(of_set);
    }

  private:
    /// Where the light of each point of a set stands, and the row of the first.
    struct Lights {
        const CurveSet& set;
        std::size_t first_row;
        std::vector<std::pair<Band, Direction>> of_points;
    };

    void add_mirrors(const Lights& lights) {
        std::map<std::tuple<double, double, double, double>, std::size_t> known;
        for (std::size_t i = 0; i < lights.of_points.size(); ++i) {
            const auto& [band, in] = lights.of_points[i];
            const Vector3 v = in.vector();
            const auto [at, fresh] =
                known.emplace(std::tuple{band.first, band.last, v.x, v.y}, result_.rows_.size());
            if (fresh) add(lights.set, band, {in, in.mirror()});
            result_.rows_[lights.first_row + i].mirror = at->second;
        }
    }

    std::size_t job(const Band& band) {
        const auto [at, fresh] = jobs_.emplace(std::pair{band.first, band.last}, result_.jobs_.size());
        if (fresh) {
            result_.jobs_.push_back(job_of(band, nodes_.wavelengths));
            result_.pair_weights_.emplace_back();
        }
        return at->second;
    }

    [[nodiscard]] Row begun(std::size_t at, double factor) const {
        const Job& job = result_.jobs_[at];
        return {at,     job.pairs.size(),    0, 0, job.wavelengths.size(), job.incidences.size(), 0,
                factor, result_.rows_.size()};
    }

    void add_hemisphere(const Band& band, const Direction& in) {
        const std::size_t at = job(band);
        Job& job = result_.jobs_[at];
        Row row = begun(at, 1);
        for (const ConeNode& out : hemisphere_nodes(in)) {
            job.pairs.push_back({in, out.direction});
            result_.pair_weights_[at].push_back(out.weight);
        }
        row.last_pair = job.pairs.size();
        row.specular_weight = 1;
        job.incidences.push_back(in);
        result_.rows_.push_back(row);
    }

    void add(const CurveSet& set, const Band& band, const DirectionPair& pair) {
        const std::size_t at = job(band);
        Job& job = result_.jobs_[at];
        const Cone source{pair.in, set.source_solid_angle, nodes_.rings};
        const Cone detector{pair.out, set.detector_solid_angle, nodes_.rings};
        const double norm = total(source.nodes) * total(detector.nodes);
        Row row = begun(at, quantity_factor(set.quantity, pair.out));
        for (const ConeNode& in : source.nodes) {
            for (const ConeNode& out : detector.nodes) {
                job.pairs.push_back({in.direction, out.direction});
                result_.pair_weights_[at].push_back(in.weight * out.weight / norm);
            }
        }
        row.last_pair = job.pairs.size();
        const SpecularView seen = specular_view(source, detector);
        row.specular_weight = seen.weight;
        if (seen.weight > 0) job.incidences.push_back(seen.incidence);
        result_.rows_.push_back(row);
    }

    Prediction& result_;
    AveragingNodes nodes_;
    std::map<std::pair<double, double>, std::size_t> jobs_;
};

Prediction::Prediction(const CurveSet& set, AveragingNodes nodes) : Prediction{std::span{&set, 1}, nodes} {}

Prediction::Prediction(std::span<const CurveSet> sets, AveragingNodes nodes) {
    require_nodes(nodes);
    Builder{*this, nodes}.add_all(sets);
}

Prediction::Prediction(const spectral::WavelengthGrid& wavelengths, std::span<const PairAtWavelength> points)
    : jobs_{{wavelengths, std::vector<double>(wavelengths.size(), 1), {}, {}}},
      pair_weights_(1),
      point_count_{points.size()} {
    const auto same = [](const Direction& a, const Direction& b) {
        const Vector3 u = a.vector(), v = b.vector();
        return u.x == v.x && u.y == v.y && u.z == v.z;
    };
    std::vector<DirectionPair>& pairs = jobs_.front().pairs;
    for (const auto& [pair, wavelength] : points) {
        if (pairs.empty() || !same(pairs.back().in, pair.in) || !same(pairs.back().out, pair.out))
            pairs.push_back(pair);
        const std::size_t last = pairs.size();
        rows_.push_back({0, last - 1, last, wavelength, wavelength + 1, 0, 0, 1, rows_.size()});
    }
    pair_weights_.front().assign(pairs.size(), 1);
}

Prediction::Answer Prediction::answer(const Job& job, const spectral::Evaluator& model) {
    const std::size_t count = job.wavelengths.size();
    Answer answer{std::vector<double>(job.pairs.size() * count),
                  std::vector<double>(job.incidences.size() * count)};
    model.brdf_batch(job.pairs, answer.brdf);
    for (std::size_t i = 0; i < job.incidences.size(); ++i)
        model.specular_reflectance(job.incidences[i],
                                   std::span{answer.specular_reflectance}.subspan(i * count, count));
    return answer;
}

std::vector<double> Prediction::average(std::span<const Answer> answers) const {
    std::vector<double> result;
    result.reserve(rows_.size());
    for (const Row& row : rows_) {
        const Answer& answer = answers[row.job];
        const std::vector<double>& over_band = jobs_[row.job].wavelength_weights;
        const std::size_t n = over_band.size();
        double sum = 0;
        for (std::size_t i = row.first_pair; i < row.last_pair; ++i) {
            const double weight = pair_weights_[row.job][i];
            for (std::size_t k = row.first_wavelength; k < row.last_wavelength; ++k)
                sum += weight * over_band[k] * answer.brdf[i * n + k];
        }
        if (row.specular_weight > 0) {
            for (std::size_t k = row.first_wavelength; k < row.last_wavelength; ++k)
                sum +=
                    row.specular_weight * over_band[k] * answer.specular_reflectance[row.incidence * n + k];
        }
        result.push_back(sum);
    }
    return result;
}

std::vector<double> Prediction::seen(std::span<const double> averages) const {
    std::vector<double> result(point_count_);
    for (std::size_t i = 0; i < point_count_; ++i) {
        const std::size_t mirror = rows_[i].mirror;
        result[i] = averages[i] * rows_[i].factor;
        if (mirror == i) continue;
        const double reference = averages[mirror] * rows_[mirror].factor;
        result[i] = reference > 0 ? result[i] / reference : 0;
    }
    return result;
}

std::vector<double> Prediction::change(std::span<const double> averages,
                                       std::span<const double> change_of_averages) const {
    std::vector<double> result(point_count_);
    for (std::size_t i = 0; i < point_count_; ++i) {
        const std::size_t mirror = rows_[i].mirror;
        result[i] = change_of_averages[i] * rows_[i].factor;
        if (mirror == i) continue;
        const double reference = averages[mirror] * rows_[mirror].factor;
        const double value = averages[i] * rows_[i].factor / reference;
        const double of_reference = change_of_averages[mirror] * rows_[mirror].factor;
        result[i] = reference > 0 ? (result[i] - value * of_reference) / reference : 0;
    }
    return result;
}

std::vector<double> Prediction::values(const spectral::Material& material,
                                       spectral::OutsideRange policy) const {
    std::vector<Answer> answers;
    answers.reserve(jobs_.size());
    for (const Job& job : jobs_) {
        const auto model =
            material.at(job.wavelengths,
                        {.tolerance = Tolerance{hts::accuracy::finest_lane_tolerance}, .outside = policy});
        answers.push_back(answer(job, model.evaluator()));
    }
    return values(answers);
}

}  // namespace hts::validation
