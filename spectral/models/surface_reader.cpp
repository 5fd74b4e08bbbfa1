#include "spectral/models/surface_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "hts/correlation/correlation.hpp"
#include "hts/error.hpp"
#include "spectral/models/power_spectrum_table.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A shape with the lengths and the roughness that its own numbers say, where they do.
struct Shape {
    std::optional<Correlation> correlation{};  // none of the Gaussian
    std::optional<CorrelationLengths> lengths{};
    std::optional<double> rms_roughness{};
    std::optional<FrequencyBand> band{};
};

bool is_list(const std::optional<JsonValue>& value) {
    return value && value->is_list();
}

/// One number, or two in a list.
CorrelationLengths lengths_from(const JsonValue& value) {
    const auto length = [](const JsonValue& of) {
        const double number = of.number();
        return located(of.place(), [&] { return Surface{1, number}.correlation_length(); });
    };
    if (!value.is_list()) return {length(value), length(value)};
    const std::vector<JsonValue> both = value.items();
    if (both.size() != 2) throw value.error("must be a number or a list of two, [along, across]");
    return {length(both[0]), length(both[1])};
}

double positive(const JsonValue& value, const char* what) {
    const double number = value.number();
    if (!(number > 0 && std::isfinite(number))) throw value.error(std::string{what} + " must be > 0");
    return number;
}

// ------------------------------------------------------------------------------------------- shapes

Shape scaled_shape(const Correlation::Scaled& made) {
    return {made.shape, CorrelationLengths{made.length, made.length}};
}

Shape spectrum_from(const JsonValue& shape, const std::filesystem::path& folder) {
    bool continued = false;
    if (const auto outside = shape.find("outside")) {
        continued = outside->text() == "power_law";
        if (!continued && outside->text() != "zero")
            throw outside->error(in_quotes(outside->text()) + " is not known; must be zero or power_law");
    }
    const PowerSpectrumTable table = power_spectrum_table(shape, folder);
    const auto make = table.of_profile ? Correlation::of_profile_spectrum : Correlation::of_spectrum;
    const Correlation::Scaled made =
        located(table.place, [&] { return make(table.frequency, table.density, continued); });
    Shape result = scaled_shape(made);
    result.rms_roughness = made.rms_roughness;
    result.band = {table.frequency.front(), table.frequency.back()};
    return result;
}

Shape autocorrelation_from(const JsonValue& shape, const std::filesystem::path& folder) {
    shape.require_keys_among({"type", "file"});
    const std::filesystem::path path = folder / shape["file"].text();
    const CsvTable table = CsvTable::read(path);
    table.require_known_columns({"distance_um", "autocorrelation"});
    std::vector<double> distance, correlation;
    const std::size_t x = table.column("distance_um"), y = table.column("autocorrelation");
    std::size_t first = 0;
    if (table.row_count() > 0 && table.number(0, x) == 0) {
        if (std::abs(table.number(0, y) - 1) > 1e-9)
            throw table.error(0, y, shortest(table.number(0, y)) + " must be 1 at the distance 0");
        first = 1;
    }
    for (std::size_t row = first; row < table.row_count(); ++row) {
        const double at = table.number(row, x), value = table.number(row, y);
        if (!(at > 0)) throw table.error(row, x, shortest(at) + " must be > 0");
        if (row > first && !(at > distance.back()))
            throw table.error(row, x,
                              shortest(at) + " must be above " + shortest(distance.back()) + " before it");
        if (!(std::abs(value) < 1)) throw table.error(row, y, shortest(value) + " must be between -1 and 1");
        distance.push_back(at);
        correlation.push_back(value);
    }
    return scaled_shape(
        located(path.string(), [&] { return Correlation::of_autocorrelation(distance, correlation); }));
}

/// K-correlation: S1 = A/(1 + (B f)^2)^(C/2), one-sided, or S2 = A/(1 + (B f)^2)^(C/2).
Shape k_correlation_from(const JsonValue& shape, bool may_be_absolute) {
    shape.require_keys_among({"type", "A", "B_um", "C", "psd"});
    const JsonValue slope = shape["C"], b_key = shape["B_um"];
    const bool of_profile = is_of_profile(shape["psd"]);
    const double c = slope.number();
    const double nu = (c - (of_profile ? 1 : 2)) / 2;
    if (!(nu >= 0.05 && nu <= 50)) {
        throw slope.error(shortest(c) +
                          (of_profile ? " must be from 1.1 to 101, the slope of a profile's spectrum"
                                      : " must be from 2.1 to 102, the slope of a surface's spectrum") +
                          "; at " + (of_profile ? "1" : "2") +
                          " and below the variance of heights is infinite");
    }
    const CorrelationLengths b = lengths_from(b_key);
    constexpr double turn = 2 * std::numbers::pi;
    Shape result{Correlation::matern(nu), CorrelationLengths{b.along / turn, b.across / turn}};
    if (const auto key = shape.find("A")) {
        if (!may_be_absolute) throw key->error("must be left out in a sum, whose weights say it");
        const double a = positive(*key, "the power at low frequencies");
        if (of_profile && b.along != b.across)
            throw key->error(
                R"(must be left out where "B_um" is a list and "psd" a profile's: of which is not said)");
        // variance = 2 pi A2/((C2 - 2) B^2), A2 = A1 B Gamma((C + 1)/2)/(2 sqrt(pi) Gamma(C/2)), C2 = C + 1
        const double of_surface = of_profile ? a * b.along / (2 * std::sqrt(std::numbers::pi)) *
                                                   std::exp(std::lgamma((c + 1) / 2) - std::lgamma(c / 2))
                                             : a;
        result.rms_roughness = std::sqrt(turn * of_surface / (2 * nu * b.along * b.across));
    }
    return result;
}

/// Two periods, the shorter first.
struct Periods {
    double shortest, longest;
};
Periods periods_from(const JsonValue& value, bool may_be_infinite) {
    const std::vector<JsonValue> both = value.items();
    if (both.size() != 2) throw value.error("must be [shortest period, longest period]");
    Periods periods{positive(both[0], "the shortest period"), infinity};
    if (!may_be_infinite || !both[1].is_text())
        periods.longest = positive(both[1], "the longest period");
    else if (both[1].text() != "infinity")
        throw both[1].error(in_quotes(both[1].text()) + R"( is not known; must be a number or "infinity")");
    if (periods.shortest < periods.longest) return periods;
    throw value.error("the shortest period, " + shortest(periods.shortest) + ", must be below the longest, " +
                      shortest(periods.longest));
}

/// S2 ~ 1/(1 + (L f)^2)^(C/2) of the surface, C one more than that of a profile, between two periods.
Shape fractal_from(const JsonValue& shape) {
    shape.require_keys_among({"type", "C", "psd", "periods_um"});
    const double c = shape["C"].number(), of_surface = is_of_profile(shape["psd"]) ? c + 1 : c;
    const Periods periods = periods_from(shape["periods_um"], false);
    const Correlation::Scaled made = located(
        shape.place(), [&] { return Correlation::fractal(of_surface, periods.longest / periods.shortest); });
    const double length = made.length * periods.longest;
    return {made.shape, CorrelationLengths{length, length}};
}

Shape matern_from(const JsonValue& shape, bool with_length) {
    auto keys = std::vector<std::string>{"type", "nu"};
    if (with_length) keys.emplace_back("length_um");
    shape.require_keys_among(keys);
    const JsonValue nu = shape["nu"];
    const double value = nu.number();
    return {located(nu.place(), [&] { return Correlation::matern(value); })};
}

const std::vector<std::string> shape_names{"gaussian", "exponential", "matern", "k_correlation",
                                           "fractal",  "sum",         "psd",    "autocorrelation"};

/// One scale of a sum.
Correlation::Part part_from(const JsonValue& pair) {
    const std::vector<JsonValue> items = pair.items();
    if (items.size() != 2) throw pair.error("must be [weight, {…}]");
    const double weight = positive(items[0], "a weight");
    const JsonValue& shape = items[1];
    const std::string type = shape["type"].text();
    if (type == "k_correlation") {
        const Shape made = k_correlation_from(shape, false);
        if (made.lengths->along != made.lengths->across)
            throw shape["B_um"].error("must be one number in a sum");
        return {weight, *made.correlation, made.lengths->along};
    }
    if (type != "gaussian" && type != "exponential" && type != "matern")
        throw shape["type"].error(
            in_quotes(type) + " " +
            must_be_one_of(type, {"gaussian", "exponential", "matern", "k_correlation"}));
    const JsonValue length_key = shape["length_um"];
    const double length = lengths_from(length_key).along;
    if (length_key.is_list()) throw length_key.error("must be one number in a sum");
    if (type == "matern") return {weight, *matern_from(shape, true).correlation, length};
    shape.require_keys_among({"type", "length_um"});
    return {weight, type == "gaussian" ? Correlation::gaussian() : Correlation::exponential(), length};
}

/// Its length is that of the part with most variance.
Shape sum_from(const JsonValue& shape) {
    shape.require_keys_among({"type", "of"});
    std::vector<Correlation::Part> parts;
    for (const JsonValue& pair : shape["of"].items()) parts.push_back(part_from(pair));
    if (parts.empty()) throw shape["of"].error("must be a list of one or more [weight, {…}]");
    double most = 0, length = 0;
    for (const Correlation::Part& part : parts) {
        if (part.weight > most) length = part.length;
        most = std::max(most, part.weight);
    }
    for (Correlation::Part& part : parts) part.length /= length;
    return {Correlation::sum(parts), CorrelationLengths{length, length}};
}

Shape shape_from(const std::optional<JsonValue>& correlation, const std::filesystem::path& folder) {
    if (!correlation) return {};
    const std::string type = correlation->is_text() ? correlation->text() : (*correlation)["type"].text();
    const bool has_numbers = type != "gaussian" && type != "exponential";
    const auto type_error = [&](const std::string& message) {
        return (correlation->is_text() ? *correlation : (*correlation)["type"]).error(message);
    };
    if (std::ranges::find(shape_names, type) == shape_names.end())
        throw type_error(in_quotes(type) + " " + must_be_one_of(type, shape_names));
    if (correlation->is_text()) {
        if (has_numbers)
            throw correlation->error(in_quotes(type) + R"(: must be an object, {"type": )" + in_quotes(type) +
                                     ", …}");
    } else if (!has_numbers) {
        correlation->require_keys_among({"type"});
    }
    if (type == "gaussian") return {};
    if (type == "exponential") return {Correlation::exponential()};
    if (type == "matern") return matern_from(*correlation, false);
    if (type == "k_correlation") return k_correlation_from(*correlation, true);
    if (type == "fractal") return fractal_from(*correlation);
    if (type == "sum") return sum_from(*correlation);
    return type == "psd" ? spectrum_from(*correlation, folder) : autocorrelation_from(*correlation, folder);
}

FrequencyBand band_from(const JsonValue& value) {
    const Periods periods = periods_from(value, true);
    return {1 / periods.longest, 1 / periods.shortest};
}

void require_absent(const std::optional<JsonValue>& value, const char* why) {
    if (value) throw value->error(std::string{"must be left out "} + why);
}

}  // namespace

const std::vector<std::string>& surface_keys() {
    static const std::vector<std::string> keys{"rms_roughness_um", "correlation_length_um", "azimuth_deg",
                                               "correlation", "rms_band_um"};
    return keys;
}

RoughSurface surface_from(const JsonValue& file, const std::filesystem::path& folder) {
    const std::optional<JsonValue> correlation = file.find("correlation"), azimuth = file.find("azimuth_deg");
    const auto roughness_key = file.find("rms_roughness_um"), length_key = file.find("correlation_length_um"),
               band_key = file.find("rms_band_um");
    // the roughness first, so that the message has the key of the one that is wrong
    double roughness = 1;
    if (roughness_key) {
        roughness = roughness_key->number();
        located(roughness_key->place(), [&] { return Surface{roughness, longest_length}; });
    }
    const Shape shape = shape_from(correlation, folder);
    if (shape.rms_roughness) {
        require_absent(roughness_key, "where the correlation is an absolute power spectrum");
        require_absent(band_key, "where the correlation is an absolute power spectrum");
        roughness = *shape.rms_roughness;
    } else {
        static_cast<void>(file["rms_roughness_um"]);
    }
    if (shape.lengths) require_absent(length_key, "where the correlation has lengths of its own");
    const CorrelationLengths lengths =
        shape.lengths ? *shape.lengths : lengths_from(file["correlation_length_um"]);
    const bool listed = shape.lengths ? lengths.along != lengths.across : is_list(length_key);
    if (azimuth && !listed)
        throw azimuth->error(shape.lengths ? "must be left out where lengths are one number"
                                           : "must be left out where correlation_length_um is one number");
    Direction axis = Direction::from_degrees(90, 0);
    if (azimuth) {
        const double degrees = azimuth->number();
        axis = located(azimuth->place(), [&] { return Direction::from_degrees(90, degrees); });
    }
    const auto with = [&](double rms) {
        const Surface surface = Surface::anisotropic(rms, lengths, axis);
        return shape.correlation ? surface.correlated(*shape.correlation) : surface;
    };
    if (!band_key) {
        const RoughSurface surface{with(roughness)};
        return shape.band ? surface.stated_for(*shape.band) : surface;
    }
    const FrequencyBand band = band_from(*band_key);
    const double share = with(roughness).variance_share(band.from, band.to);
    if (!(share > 1e-12))
        throw band_key->error("must hold some of the roughness: this surface has none at these periods");
    const double whole = roughness / std::sqrt(share);
    return RoughSurface{located(band_key->place(), [&] { return with(whole); })}.stated_for(band);
}

}  // namespace hts::spectral
