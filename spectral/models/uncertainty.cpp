#include "spectral/models/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hts/error.hpp"
#include "hts/he_torrance_gradient.hpp"
#include "spectral/models/power_spectrum_table.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {

/// A tabulated spectrum with the errors of its rows.
struct SpectrumErrors {
    /// Rows that are changed together: one each, or where there are many all within a step of ln f.
    struct Band {
        std::size_t first, last;  // rows, last not in it
        /// Relative change of all of them that has the effect of their errors, which are independent: the
        /// effects of neighbours on what is reflected are alike, so their squares add up.
        double deviation;
    };
    PowerSpectrumTable table;
    std::vector<Band> bands;
};

namespace {

using nlohmann::json;

constexpr double step = 0.25;    // of a standard deviation, to either side
constexpr double finest = 1e-9;  // of the values whose difference is taken
constexpr std::size_t most_numbers = 64;

// ---- exact derivatives

/// The derivative of a gradient that a name means; null of others.
double Gradient<>::*exact_derivative(const std::string& name) {
    if (name == "rms_roughness_um") return &Gradient<>::rms_roughness;
    if (name == "correlation_length_um") return &Gradient<>::correlation_length;
    if (name == "correlation_length_um/0") return &Gradient<>::correlation_length_x;
    if (name == "correlation_length_um/1") return &Gradient<>::correlation_length_y;
    if (name == "n" || name == "index/n") return &Gradient<>::n;
    if (name == "k" || name == "index/k") return &Gradient<>::k;
    if (name == "diffuse_albedo") return &Gradient<>::diffuse_albedo;
    return nullptr;
}

class ExactChange final : public UncertainReflectance::Change {
  public:
    ExactChange(Reflectance of, double Gradient<>::*by, double deviation)
        : of_{std::move(of)}, by_{by}, deviation_{deviation} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const override {
        const PairGradient gradient{*of_.properties().surface, pair.in, pair.out};
        const auto samples = of_.samples();
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto f = brdf_gradient(gradient, samples[i].wavelength, samples[i].index.substrate(),
                                         samples[i].uniform_diffuse);
            values[i] = deviation_ * f.by.*by_;
        }
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const override {
        const Surface& surface = *of_.properties().surface;
        const auto view = view_gradient(surface, in);
        const auto samples = of_.samples();
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto r = specular_reflectance_gradient(surface, view, samples[i].wavelength,
                                                         samples[i].index.substrate());
            values[i] = deviation_ * r.by.*by_;
        }
    }

  private:
    Reflectance of_;
    double Gradient<>::*by_;
    double deviation_;
};

// ---- differences

/// Between two reflectances, of all wavelengths or, of several, one of each.
class Difference final : public UncertainReflectance::Change {
  public:
    ///   steps   between above and below, in standard deviations
    Difference(std::vector<Reflectance> above, std::vector<Reflectance> below, double steps)
        : above_{std::move(above)}, below_{std::move(below)}, steps_{steps} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const override {
        combine(values, [&](const Reflectance& of, std::span<double> part) { of.brdf(pair, part); });
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const override {
        combine(values,
                [&](const Reflectance& of, std::span<double> part) { of.specular_reflectance(in, part); });
    }

  private:
    template <class Ask>
    void combine(std::span<double> values, const Ask& ask) const {
        std::vector<double> below(values.size());
        std::size_t at = 0;
        for (std::size_t i = 0; i < above_.size(); at += above_[i++].size()) {
            ask(above_[i], values.subspan(at, above_[i].size()));
            ask(below_[i], std::span{below}.subspan(at, below_[i].size()));
        }
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = (values[i] - below[i]) / steps_;
    }

    std::vector<Reflectance> above_, below_;
    double steps_;
};

/// A difference as wide as the legal range allows.
///   at   the reflectances where the number is off by so many standard deviations
template <class At>
std::shared_ptr<const Difference> difference(const At& at) {
    const auto within = [&](double off) -> std::optional<std::vector<Reflectance>> {
        try {
            return at(off);
        } catch (const Error&) {
            return std::nullopt;
        }
    };
    auto above = within(step), below = within(-step);
    const double steps = (above ? step : 0) + (below ? step : 0);
    if (!above) above = at(below ? 0 : step);  // says what is wrong where neither side can be
    if (!below) below = at(0);
    return std::make_shared<const Difference>(std::move(*above), std::move(*below), steps);
}

// ---- what the file says

/// Whether errors can have these correlations: no negative pivot of Cholesky's.
bool possible(std::vector<double> matrix, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
        const double pivot = matrix[k * n + k];
        if (pivot < -1e-9) return false;
        for (std::size_t i = k + 1; i < n; ++i) {
            if (pivot < 1e-9) {
                if (std::abs(matrix[i * n + k]) > 1e-6) return false;
                continue;
            }
            const double factor = matrix[i * n + k] / pivot;
            for (std::size_t j = k; j < n; ++j) matrix[i * n + j] -= factor * matrix[k * n + j];
        }
    }
    return true;
}

std::vector<SpectrumErrors::Band> bands_of(const PowerSpectrumTable& table) {
    constexpr std::size_t most_single = 48, most_bands = 32;
    const std::size_t rows = table.frequency.size();
    const double first = std::log(table.frequency.front()), last = std::log(table.frequency.back());
    const auto band_of = [&](std::size_t row) {
        if (rows <= most_single) return row;
        const double share = (std::log(table.frequency[row]) - first) / (last - first);
        return std::min(static_cast<std::size_t>(share * most_bands), most_bands - 1);
    };
    std::vector<SpectrumErrors::Band> bands;
    for (std::size_t row = 0; row < rows;) {
        SpectrumErrors::Band band{row, row, 0};
        double squares = 0;
        for (; band.last < rows && band_of(band.last) == band_of(row); ++band.last)
            squares += std::pow(table.error[band.last] / table.density[band.last], 2);
        row = band.last;
        band.deviation = std::sqrt(squares) / static_cast<double>(band.last - band.first);
        if (band.deviation > 0) bands.push_back(band);
    }
    return bands;
}

/// Of a material file; null where its correlation is no table with errors.
std::shared_ptr<const SpectrumErrors> spectrum_errors(const JsonValue& file,
                                                      const std::filesystem::path& folder) {
    const auto correlation = file.find("correlation");
    if (!correlation || !correlation->is_object() || (*correlation)["type"].text() != "psd") return nullptr;
    PowerSpectrumTable table = power_spectrum_table(*correlation, folder);
    if (table.error.empty()) return nullptr;
    auto bands = bands_of(table);
    return std::make_shared<const SpectrumErrors>(SpectrumErrors{std::move(table), std::move(bands)});
}

/// The correlation with its bands changed by so many parts.
json changed(const json& correlation, const SpectrumErrors& errors, std::span<const double> differences) {
    std::vector<double> density = errors.table.density;
    for (std::size_t i = 0; i < errors.bands.size(); ++i)
        for (std::size_t row = errors.bands[i].first; row < errors.bands[i].last; ++row)
            density[row] *= 1 + differences[i];
    json rows = json::array();
    for (std::size_t row = 0; row < density.size(); ++row)
        rows.push_back(json::array({errors.table.frequency[row], density[row]}));
    json result{{"type", "psd"}, {"table", rows}, {"psd", errors.table.of_profile ? "1d one-sided" : "2d"}};
    if (correlation.contains("outside")) result["outside"] = correlation["outside"];
    return result;
}

/// The number of a file that a name means; "" where the file gives the index in another way.
std::string pointer_of(const json& file, const std::string& name, const std::string& place) {
    const auto is_number = [&](const std::string& pointer) {
        try {
            const json::json_pointer to{pointer};
            return file.contains(to) && file.at(to).is_number();
        } catch (const json::exception&) {
            return false;
        }
    };
    if (is_number("/" + name)) return "/" + name;
    if ((name == "n" || name == "k") && is_number("/index/" + name)) return "/index/" + name;
    if ((name == "n" || name == "k") && file.contains("index")) return "";
    throw Error{place +
                ": must name a number of the material file, as rms_roughness_um, correlation/B_um or n"};
}

double deviation_from(const JsonValue& value) {
    const double number = value.number();
    if (!(number > 0 && std::isfinite(number)))
        throw value.error(shortest(number) + ": a standard deviation must be > 0");
    return number;
}

}  // namespace

template <class Ask>
void UncertainReflectance::combine(std::span<double> deviations, const Ask& ask) const {
    const std::size_t count = changes_.size(), width = deviations.size();
    std::vector<double> changes(count * width);
    for (std::size_t i = 0; i < count; ++i) ask(*changes_[i], std::span{changes}.subspan(i * width, width));
    for (std::size_t w = 0; w < width; ++w) {
        double variance = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j)
                variance += correlations_[i * count + j] * changes[i * width + w] * changes[j * width + w];
        deviations[w] = std::sqrt(std::max(variance, 0.0));  // below 0 by rounding alone
    }
}

void UncertainReflectance::brdf(const DirectionPair& pair, std::span<double> deviations) const {
    combine(deviations, [&](const Change& of, std::span<double> values) { of.brdf(pair, values); });
}

void UncertainReflectance::specular_reflectance(const Direction& in, std::span<double> deviations) const {
    combine(deviations,
            [&](const Change& of, std::span<double> values) { of.specular_reflectance(in, values); });
}

UncertainMaterial::UncertainMaterial(const std::string& text, std::filesystem::path path,
                                     const std::vector<UncertainNumber>& given,
                                     const std::vector<ModelEntry>& models)
    : text_{text},
      path_{std::move(path)},
      models_{models},
      material_{material_from_text(text, path_, models)},
      numbers_{given} {
    const JsonValue read = JsonValue::parse(text, path_.string());
    const json file = json::parse(text);
    for (const UncertainNumber& each : given) {
        pointers_.push_back(pointer_of(file, each.name, each.name));
        if (!(each.standard_deviation > 0 && std::isfinite(each.standard_deviation)))
            throw Error{each.name + ": standard deviation " + shortest(each.standard_deviation) +
                        ": must be > 0"};
    }
    const auto place = [&](const std::string& name) {
        return static_cast<std::size_t>(
            std::ranges::find_if(numbers_, [&](const auto& each) { return each.name == name; }) -
            numbers_.begin());
    };
    const auto stated = read.find("uncertainty");
    if (stated) {
        for (const auto& [name, value] : file["uncertainty"].items()) {
            if (name == "correlated" || place(name) < numbers_.size()) continue;
            const JsonValue number = (*stated)[name];
            pointers_.push_back(pointer_of(file, name, number.place()));
            numbers_.push_back({name, deviation_from(number)});
        }
    }
    spectrum_ = spectrum_errors(read, path_.parent_path());
    for (std::size_t i = 0; spectrum_ && i < spectrum_->bands.size(); ++i) {
        const auto& [first, last, deviation] = spectrum_->bands[i];
        std::string name = "power spectrum at " + brief(spectrum_->table.frequency[first], 3);
        if (last - first > 1) name += " ... " + brief(spectrum_->table.frequency[last - 1], 3);
        numbers_.push_back({name + "/um", deviation});
    }
    if (numbers_.empty())
        throw Error{path_.string() + R"(: key "uncertainty": missing, or without a standard deviation)"};
    const std::size_t count = numbers_.size();
    if (count > most_numbers)
        throw out_of_range("number of uncertain numbers", static_cast<double>(count), "",
                           "at most " + std::to_string(most_numbers));
    correlations_.assign(count * count, 0);
    for (std::size_t i = 0; i < count; ++i) correlations_[i * count + i] = 1;
    const auto correlated = stated ? stated->find("correlated") : std::nullopt;
    if (!correlated) return;
    for (const JsonValue& row : correlated->items()) {
        const auto items = row.items();
        if (items.size() != 3) throw row.error("must be [name, name, correlation]");
        const std::size_t i = place(items[0].text()), j = place(items[1].text());
        if (i == count || j == count || i == j)
            throw row.error("must name two numbers that have a standard deviation");
        const double r = items[2].number();
        if (!(std::abs(r) <= 1)) throw items[2].error(shortest(r) + ": must be from -1 to 1");
        if (i < given.size() || j < given.size()) continue;  // another error than the one it is of
        correlations_[i * count + j] = correlations_[j * count + i] = r;
    }
    if (!possible(correlations_, count))
        throw correlated->error(
            "no errors have all these correlations: the matrix has a negative eigenvalue");
}

Material UncertainMaterial::with(std::span<const double> differences) const {
    json file = json::parse(text_);
    const auto of_spectrum = differences.subspan(pointers_.size());
    if (std::ranges::any_of(of_spectrum, [](double d) { return d != 0; }))
        file["correlation"] = changed(file["correlation"], *spectrum_, of_spectrum);
    for (std::size_t i = 0; i < pointers_.size(); ++i) {
        if (pointers_[i].empty()) {
            if (differences[i] == 0) continue;
            throw Error{path_.string() + ": " + numbers_[i].name +
                        R"(: the key "index" must be {"n": …, "k": …} to be given other values)"};
        }
        json& number = file.at(json::json_pointer{pointers_[i]});
        number = number.get<double>() + differences[i];
    }
    return material_from_text(file.dump(), path_, models_);
}

bool UncertainMaterial::has_exact_derivatives(const Reflectance& reflectance) const {
    if (material_.model_name() != "he" || !material_.properties().surface) return false;
    if (material_.properties().surface->correlation() || material_.properties().surface->band()) return false;
    return std::ranges::none_of(reflectance.samples(),
                                [](const SpectralSample& sample) { return sample.index.coated(); });
}

UncertainReflectance UncertainMaterial::at(const WavelengthGrid& wavelengths,
                                           const EvaluationOptions& options) const {
    const Reflectance own = material_.at(wavelengths, options);
    const bool exact = has_exact_derivatives(own);
    EvaluationOptions how = options;
    how.tolerance = Tolerance{std::min(finest, options.tolerance.relative_error())};
    const auto moved = [&](std::size_t k) {
        return [&, k](double steps) {
            std::vector<double> differences(numbers_.size());
            differences[k] = steps * numbers_[k].standard_deviation;
            const Material other = with(differences);
            // nobody asks for its tables again
            const auto& surface = other.properties().surface;
            if (surface && surface->correlation()) surface->correlation()->prepare_unkept();
            return std::vector{other.at(wavelengths, how)};
        };
    };
    const auto index_moved = [&](std::size_t k) {
        return [&, k](double steps) {
            std::vector<Reflectance> each;
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                const RefractiveIndex& index = own.samples()[w].index.substrate();
                const double off = steps * numbers_[k].standard_deviation;
                EvaluationOptions other = how;
                other.instead.n = index.n() + (numbers_[k].name == "n" ? off : 0);
                other.instead.k = index.k() + (numbers_[k].name == "k" ? off : 0);
                each.push_back(material_.at(wavelengths[w], other));
            }
            return each;
        };
    };
    std::vector<std::shared_ptr<const UncertainReflectance::Change>> changes(numbers_.size());
    parallel_for(numbers_.size(), [&](std::size_t k) {
        const auto derivative = exact ? exact_derivative(numbers_[k].name) : nullptr;
        if (derivative != nullptr) {
            changes[k] = std::make_shared<const ExactChange>(own, derivative, numbers_[k].standard_deviation);
        } else if (k < pointers_.size() && pointers_[k].empty() && material_.properties().surface) {
            changes[k] = difference(index_moved(k));
        } else {
            changes[k] = difference(moved(k));
        }
    });
    return {std::move(changes), correlations_};
}

}  // namespace hts::spectral
