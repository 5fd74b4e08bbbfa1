#include "evaluation.hpp"

#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <array>

#include "hts/error.hpp"
#include "pairs.hpp"
#include "spectral/parallel.hpp"

namespace hts::python {
namespace {

using spectral::Reflectance;
using spectral::WavelengthGrid;

/// The operands of a call.
struct Operands {
    std::optional<Operand> wavelength;
    std::vector<Operand> angles;     ///< theta_i, phi_i, theta_r, phi; or none
    std::vector<Operand> vectors;    ///< incident, reflected; or none
    std::vector<Operand> overrides;  ///< those given
    std::vector<int> which;  ///< of overrides: 0 n, 1 k, 2 rms roughness, 3 correlation length, 4 albedo

    [[nodiscard]] std::vector<const Operand*> all() const {
        std::vector<const Operand*> all;
        if (wavelength) all.push_back(&*wavelength);
        for (const auto* group : {&angles, &vectors, &overrides}) {
            for (const Operand& operand : *group) all.push_back(&operand);
        }
        return all;
    }
};

bool given(nb::handle value) {
    return value.is_valid() && !value.is_none();
}

void require_given(const char* name, nb::handle value) {
    if (!given(value))
        throw Error{std::string{name} + ": must be given, or incident and reflected as vectors"};
}

Operands operands_of(const Quantity& quantity, const Where& where) {
    Operands of;
    of.wavelength.emplace("wavelength", where.wavelength);
    const bool vectors = given(where.incident) || given(where.reflected);
    if (vectors) {
        for (const nb::handle angle : {where.theta_i, where.theta_r, where.phi}) {
            if (given(angle)) throw Error{"directions given twice: must be either angles or vectors"};
        }
        if (!given(where.incident)) throw Error{"incident: must be given with reflected"};
        of.vectors.emplace_back("incident", where.incident, 3);
        if (quantity.views) {
            if (!given(where.reflected)) throw Error{"reflected: must be given with incident"};
            of.vectors.emplace_back("reflected", where.reflected, 3);
        } else if (given(where.reflected)) {
            throw Error{std::string{"reflected: "} + quantity.name +
                        " depends on the incident direction alone"};
        }
    } else {
        require_given("theta_i", where.theta_i);
        of.angles.emplace_back("theta_i", where.theta_i);
        of.angles.emplace_back("phi_i", where.phi_i);
        if (quantity.views) {
            require_given("theta_r", where.theta_r);
            require_given("phi", where.phi);
            of.angles.emplace_back("theta_r", where.theta_r);
            of.angles.emplace_back("phi", where.phi);
        }
    }
    const std::pair<const char*, nb::handle> own[]{{"n", where.n},
                                                   {"k", where.k},
                                                   {"rms_roughness_um", where.rms_roughness},
                                                   {"correlation_length_um", where.correlation_length},
                                                   {"diffuse_albedo", where.diffuse_albedo}};
    for (int i = 0; i < 5; ++i) {
        if (!given(own[i].second)) continue;
        of.overrides.emplace_back(own[i].first, own[i].second);
        of.which.push_back(i);
    }
    return of;
}

/// Whether this thread forked, in the child: OpenMP's other threads stayed behind, and a loop that is shared
/// with them would wait for ever.
thread_local bool forked = false;

/// Parallel loops of this thread run on so many threads for as long as it lives; on all cores for 0.
class Team {
  public:
    explicit Team(int threads) : before_{omp_get_max_threads()} {
        if (threads > 0 && !forked) omp_set_num_threads(threads);
    }
    ~Team() { omp_set_num_threads(before_); }
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

  private:
    int before_;
};

void require_threads(int threads) {
    if (threads < 0 || threads > 1024)
        throw Error{"threads " + std::to_string(threads) + ": must be 0, for all cores, ... 1024"};
}

/// Calls f(first, number) for blocks of 0 … count - 1 on as many threads as asked, without Python's lock.
/// The error of the lowest block is thrown.
///   slow   whether an element takes so long that each goes to whichever thread is free
template <class Function>
void in_blocks(std::size_t count, int threads, bool slow, const Function& f) {
    const std::size_t size = slow ? 1 : Pairs::most;
    const Team team{threads};
    const nb::gil_scoped_release others_may_run;
    spectral::parallel_for((count + size - 1) / size,
                           [&](std::size_t i) { f(i * size, std::min(size, count - i * size)); },
                           slow ? 1 : 4);
}

/// A call in full: what is to be computed, of what, and where it goes.
class Call {
  public:
    Call(const PyMaterial& material, const Quantity& quantity, const Where& where, const How& how,
         const Operands& operands, Result& result, const Broadcast& broadcast)
        : material_{material},
          quantity_{quantity},
          how_{how},
          threads_{where.threads},
          operands_{operands},
          shape_{broadcast.shape()},
          pairs_{operands.angles, operands.vectors, broadcast, where.degrees},
          wavelength_steps_{broadcast.steps(*operands.wavelength)},
          out_{result.data()},
          out_steps_{result.strides()},
          each_{size_of(quantity.trailing)} {
        require_threads(where.threads);
        out_steps_.resize(shape_.size());
        for (const Operand& each : operands.overrides) override_steps_.push_back(broadcast.steps(each));
        for (std::size_t axis = 0; axis < shape_.size(); ++axis) {
            const auto moves = [&](const Operand& operand) { return broadcast.steps(operand)[axis] != 0; };
            const bool spectral = wavelength_steps_[axis] != 0;
            bool others = false;
            for (const auto* group : {&operands.angles, &operands.vectors, &operands.overrides})
                others = others || std::any_of(group->begin(), group->end(), moves);
            along_wavelengths_.push_back(spectral && !others);
            if (!along_wavelengths_.back()) pair_shape_.push_back(shape_[axis]);
            separable_ = separable_ && !(spectral && others);
        }
        for (const Operand& each : operands.overrides) separable_ = separable_ && size_of(each.shape()) == 1;
        separable_ = separable_ && !quantity.samplers;
    }

    void run() const {
        if (size_of(shape_) == 0) return;
        separable_ ? by_spectra() : by_elements();
    }

  private:
    /// What f returns; its error says which element it was.
    ///   i   of the element, once f has ended
    template <class Function>
    auto named(const std::size_t& i, const Function& f) const {
        if (size_of(shape_) == 1 || !separable_) return of_element(shape_, i, f);
        return of_element(pair_shape_, i, f, "pair of directions");
    }

    void store(const double* values, std::ptrdiff_t to) const { std::copy_n(values, each_, out_ + to); }

    [[nodiscard]] spectral::RoughSurfaceValues instead(const Walk& walk, std::size_t i) const {
        spectral::RoughSurfaceValues result;
        std::optional<double>* const places[]{&result.n, &result.k, &result.rms_roughness,
                                              &result.correlation_length, &result.diffuse_albedo};
        for (std::size_t o = 0; o < override_steps_.size(); ++o) {
            *places[operands_.which[o]] = operands_.overrides[o].data()[walk.offset(i, override_steps_[o])];
        }
        return result;
    }

    /// Wavelengths run along axes of their own: whole spectra of each pair of directions, in batches.
    void by_spectra() const {
        std::vector<bool> along_pairs = along_wavelengths_;
        along_pairs.flip();
        const Walk spectrum{shape_, along_wavelengths_}, pairs{shape_, along_pairs};

        std::vector<double> asked(spectrum.size());
        std::vector<std::ptrdiff_t> to(spectrum.size());
        for (std::size_t i = 0; i < asked.size(); ++i) {
            asked[i] = operands_.wavelength->data()[spectrum.offset(i, wavelength_steps_)];
            to[i] = spectrum.offset(i, out_steps_);
        }
        std::vector<double> sorted = asked;
        std::ranges::sort(sorted);
        const auto repeated = std::ranges::unique(sorted);
        sorted.erase(repeated.begin(), repeated.end());
        std::vector<std::size_t> place(asked.size());
        for (std::size_t i = 0; i < asked.size(); ++i) {
            place[i] = static_cast<std::size_t>(std::ranges::lower_bound(sorted, asked[i]) - sorted.begin());
        }
        const spectral::RoughSurfaceValues own = instead(pairs, 0);
        const Reflectance of = sorted.size() == 1
                                   ? material_.at(sorted[0], how_, own)
                                   : material_.at(WavelengthGrid::from_micrometres(sorted), how_, own);

        const std::size_t values = of.size() * each_;
        // whether the spectrum of a pair lies in the result as it is evaluated
        bool in_order = place.size() == of.size();
        for (std::size_t w = 0; w < place.size(); ++w)
            in_order = in_order && place[w] == w && to[w] == static_cast<std::ptrdiff_t>(w * each_);
        in_blocks(pairs.size(), threads_, quantity_.slow, [&](std::size_t first, std::size_t number) {
            thread_local std::vector<double> spectra;
            const auto of_block = block_of(pairs, first, number);
            std::array<std::ptrdiff_t, Pairs::most> row;
            pairs.offsets(first, out_steps_, std::span{row}.first(number));
            bool adjacent = in_order;
            for (std::size_t i = 0; i < number; ++i)
                adjacent = adjacent && row[i] - row[0] == static_cast<std::ptrdiff_t>(i * values);
            if (adjacent) {
                quantity_.evaluate(of, of_block, {out_ + row[0], number * values});
                return;
            }
            spectra.resize(number * values);
            quantity_.evaluate(of, of_block, spectra);
            for (std::size_t i = 0; i < number; ++i) {
                for (std::size_t w = 0; w < place.size(); ++w)
                    store(spectra.data() + i * values + place[w] * each_, row[i] + to[w]);
            }
        });
    }

    /// Each element has a wavelength, or a surface, of its own.
    void by_elements() const {
        const Walk all{shape_, std::vector<bool>(shape_.size(), true)};
        in_blocks(all.size(), threads_, quantity_.slow, [&](std::size_t first, std::size_t number) {
            thread_local std::vector<double> values;
            values.resize(each_);
            const auto of_block = block_of(all, first, number);
            for (std::size_t i = first; i < first + number; ++i) {
                const auto one = of_block.subspan(i - first, 1);
                const double wavelength = operands_.wavelength->data()[all.offset(i, wavelength_steps_)];
                const std::span<double> of_one{values};
                named(i, [&] {
                    if (quantity_.samplers) {
                        quantity_.of_sampler(material_.sampler(wavelength, how_), one, of_one);
                    } else {
                        quantity_.evaluate(material_.at(wavelength, how_, instead(all, i)), one, of_one);
                    }
                });
                store(values.data(), all.offset(i, out_steps_));
            }
        });
    }

    [[nodiscard]] std::span<const DirectionPair> block_of(const Walk& walk, std::size_t first,
                                                          std::size_t number) const {
        std::size_t element = first;
        return named(element, [&] { return pairs_.of_block(walk, element, number); });
    }

    const PyMaterial& material_;
    const Quantity& quantity_;
    How how_;
    int threads_;
    const Operands& operands_;
    Shape shape_;
    Pairs pairs_;
    Shape wavelength_steps_;
    double* out_;
    Shape out_steps_;
    std::size_t each_;
    std::vector<Shape> override_steps_;
    std::vector<bool> along_wavelengths_;
    Shape pair_shape_;  ///< of the axes along which directions change
    bool separable_ = true;
};

bool is_number(nb::handle value) {
    if (!value.is_valid()) return false;
    if (PyFloat_CheckExact(value.ptr())) return true;
    if (!PyLong_CheckExact(value.ptr())) return false;
    const bool too_large = PyLong_AsDouble(value.ptr()) == -1.0 && PyErr_Occurred() != nullptr;
    PyErr_Clear();
    return !too_large;
}

/// One pair of directions at one wavelength, all of them plain numbers.
std::optional<double> of_numbers(const PyMaterial& material, const Quantity& quantity, const Where& w,
                                 const How& how) {
    require_threads(w.threads);
    if (!quantity.trailing.empty() || quantity.samplers || given(w.incident) || given(w.reflected))
        return std::nullopt;
    if (!is_number(w.wavelength) || !is_number(w.theta_i) || !is_number(w.phi_i)) return std::nullopt;
    if (quantity.views && (!is_number(w.theta_r) || !is_number(w.phi))) return std::nullopt;
    for (const nb::handle own : {w.n, w.k, w.rms_roughness, w.correlation_length, w.diffuse_albedo}) {
        if (given(own)) return std::nullopt;
    }
    const auto number = [](nb::handle value) { return nb::cast<double>(value); };
    const double phi_i = number(w.phi_i);
    const Direction in = direction(number(w.theta_i), phi_i, w.degrees);
    const Direction out =
        quantity.views ? direction(number(w.theta_r), phi_i + number(w.phi), w.degrees) : in;
    const DirectionPair pair[1]{{in, out}};
    double value[1];
    quantity.evaluate(material.at(number(w.wavelength), how), pair, value);
    return value[0];
}

}  // namespace

void survive_forks() {
    pthread_atfork(nullptr, nullptr, [] {
        forked = true;
        omp_set_num_threads(1);
    });
}

nb::object evaluate(const PyMaterial& material, const Quantity& quantity, const Where& where, const How& how,
                    nb::object out) {
    if (out.is_none()) {
        if (const auto value = of_numbers(material, quantity, where, how)) return nb::float_(*value);
    }
    const Operands operands = operands_of(quantity, where);
    const auto all = operands.all();
    const Broadcast broadcast{all};
    Shape shape = broadcast.shape();
    shape.insert(shape.end(), quantity.trailing.begin(), quantity.trailing.end());
    Result result{shape, std::move(out), all, quantity.trailing.size()};
    Call{material, quantity, where, how, operands, result, broadcast}.run();
    return result.finish();
}

}  // namespace hts::python
