#include "cli/io/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <utility>

#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::cli {
namespace {

std::vector<double> numbers(const std::string& text, const std::string& quantity) {
    std::vector<double> values;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        values.push_back(spectral::number_in(text.substr(start, end - start), quantity));
        start = end + 1;
    }
    return values;
}

Stokes stokes_from_numbers(const std::string& text) {
    const std::vector<double> s = numbers(text, "Stokes parameter");
    if (s.size() != 4) throw Error{"\"" + text + "\": must be s, p, unpolarised or s0,s1,s2,s3"};
    return {s[0], s[1], s[2], s[3]};
}

/// "" where `legal` holds, else what is wrong; the command line puts the option's name in front.
template <class Legal>
CLI::Validator must_be(const std::string& range, Legal&& legal) {
    return {[range, legal](const std::string& text) {
                return legal(text) ? std::string{} : spectral::in_quotes(text) + ": must be " + range;
            },
            ""};
}

/// "+30" is 30.
template <class Number>
bool within(const std::string& text, Number first, Number last) {
    Number value{};
    const char* const end = text.data() + text.size();
    const bool plus = text.starts_with('+') && !text.starts_with("+-");
    const auto [stop, problem] = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
    return problem == std::errc{} && stop == end && value >= first && value <= last;
}

std::map<const CLI::Option*, std::vector<std::string>>& choices() {
    static std::map<const CLI::Option*, std::vector<std::string>> all;
    return all;
}

/// Infinity and NaN, too: what they cannot be, and why, is said with the quantity's range.
double angle_in(const std::string& text) {
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = problem == std::errc{} && end == text.data() + text.size();
    return whole && !std::isfinite(value) ? value : spectral::number_in(text);
}

/// Each piece between commas by `parsed`, which throws hts::Error.
template <class Value, class Parsed>
CLI::Option* list_option(CLI::App& verb, const std::string& names, std::vector<Value>& values,
                         const std::string& description, const Parsed& parsed) {
    const std::string option = names.substr(0, names.find(','));
    const auto take = [&values, option, parsed](const std::vector<std::string>& texts) {
        values.clear();
        for (const std::string& text : texts) {
            for (const std::string_view piece : spectral::split(text, ','))
                values.push_back(from_option(option, [&] { return parsed(std::string{piece}); }));
        }
    };
    return verb.add_option_function<std::vector<std::string>>(names, take, description);
}

CLI::Validator path_to_write() {
    return must_be("a name", [](const std::string& path) { return !path.empty(); });
}

/// `hts` makes it before it reads its arguments.
spectral::RunFiles& run_files() {
    return *spectral::RunFiles::of_process();
}

[[noreturn]] void refuse_model(const spectral::Material& material, const std::string& option) {
    throw UsageError{option + ": must come with a material of model he; " + material.name() + " has model " +
                     material.model_name()};
}

}  // namespace

CLI::Validator whole_number(std::uint64_t first, std::uint64_t last) {
    const std::string range = "a whole number from " + std::to_string(first) + " to " + std::to_string(last);
    return must_be(range, [=](const std::string& text) { return within(text, first, last); });
}

CLI::Validator number_within(double first, double last) {
    const std::string range = "a number from " + shortest(first) + " to " + shortest(last);
    return must_be(range, [=](const std::string& text) { return within(text, first, last); });
}

CLI::Validator seed_number() {
    return whole_number(0, std::numeric_limits<std::uint64_t>::max());
}

CLI::Option* one_of(CLI::Option* option, std::vector<std::string> names) {
    option->check(CLI::Validator{[names](const std::string& text) -> std::string {
                                     if (std::ranges::find(names, text) != names.end()) return "";
                                     return spectral::in_quotes(text) + ": " +
                                            spectral::must_be_one_of(text, names);
                                 },
                                 ""});
    return offers(option, std::move(names));
}

CLI::Option* offers(CLI::Option* option, std::vector<std::string> names) {
    choices()[option] = std::move(names);
    return option;
}

const std::vector<std::string>& choices_of(const CLI::Option* option) {
    static const std::vector<std::string> none;
    const auto found = choices().find(option);
    return found == choices().end() ? none : found->second;
}

CLI::Option* comma_list(CLI::App& verb, const std::string& names, std::vector<double>& values,
                        const std::string& description) {
    std::string defaults;
    for (const double value : values) defaults.append(defaults.empty() ? "" : ",").append(shortest(value));
    return list_option(verb, names, values, description,
                       [](const std::string& piece) { return angle_in(piece); })
        ->type_name("TEXT")
        ->default_str(defaults);
}

CLI::Option* comma_list(CLI::App& verb, const std::string& names, std::vector<std::string>& values,
                        const std::string& description) {
    return list_option(verb, names, values, description, [](const std::string& piece) {
        if (piece.empty()) throw Error{"\"\": must not be empty"};
        return piece;
    });
}

CLI::Option* more_columns(CLI::App& verb, std::vector<std::string>& columns, std::vector<std::string> known,
                          const std::string& description) {
    const auto checked = [&columns, known](const std::string& piece) {
        if (std::ranges::find(known, piece) == known.end())
            throw Error{spectral::in_quotes(piece) + ": " + spectral::must_be_one_of(piece, known)};
        if (std::ranges::find(columns, piece) != columns.end())
            throw Error{spectral::in_quotes(piece) + ": must be there once"};
        return piece;
    };
    return offers(list_option(verb, "--columns", columns, description, checked), std::move(known));
}

CLI::Option* reads_whole(CLI::Option* option) {
    return reads(option->transform(
        [](const std::string& path) { return path == "-" ? std::string{"/dev/stdin"} : path; }));
}

CLI::Option* reads(CLI::Option* option) {
    return option->each([](const std::string& path) { run_files().will_read(path); });
}

CLI::Option* writes(CLI::Option* option, Beside beside) {
    return option->check(path_to_write())->each([beside](const std::string& path) {
        run_files().will_write(path);
        if (beside == nullptr || path == "-") return;
        for (const std::string& each : beside(path)) run_files().will_write(each);
    });
}

CLI::Option* draws(CLI::Option* option) {
    const auto legal = [](const std::string& path) { return path.ends_with(".svg"); };
    return writes(option->check(must_be("a file .svg", legal)), [](const std::string& path) {
        return std::vector{std::filesystem::path{path}.replace_extension(".gnuplot").string()};
    });
}

CLI::Option* fills(CLI::Option* option, const std::vector<std::string>& names) {
    return option->check(path_to_write())->each([names](const std::string& folder) {
        run_files().will_fill(folder);
        for (const std::string& name : names)
            run_files().will_write((std::filesystem::path{folder} / name).string());
    });
}

void DirectionOptions::add_to(CLI::App& verb) {
    verb.add_option(theta_i_names, theta_i, "polar angle of the light [deg], 0 ... 90");
    verb.add_option("--theta-r", theta_r, "polar angle of the view [deg], 0 ... 90");
    verb.add_option("--phi", phi, "azimuth between light and view [deg]; mirror: 180");
    verb.add_option("--phi-i", phi_i, "azimuth of the light [deg], default 0");
    verb.add_option("--phi-r", phi_r, "azimuth of the view [deg]");
}

bool DirectionOptions::any() const noexcept {
    return theta_i || theta_r || phi || phi_i || phi_r;
}

std::string DirectionOptions::missing() const {
    if (!theta_i) return "--theta-i";
    if (!theta_r) return "--theta-r";
    if (phi || phi_r) return "";
    return phi_i ? "--phi-r" : "--phi";
}

spectral::DirectionPair DirectionOptions::pair() const {
    if (!missing().empty()) throw UsageError{missing() + " missing: must be given in degrees"};
    if (phi && (phi_i || phi_r)) throw UsageError{"--phi: must not come with --phi-i or --phi-r"};
    const auto incident = [&] { return Direction::from_degrees(*theta_i, incident_azimuth()); };
    const auto reflected = [&] { return Direction::from_degrees(*theta_r, reflected_azimuth()); };
    return {from_option("light", incident), from_option("view", reflected)};
}

void OutputOptions::add_to(CLI::App& verb, Beside beside) {
    writes(verb.add_option("--output,-o", path, "file to write, - for standard output; .json gives JSON"),
           beside)
        ->capture_default_str();
    verb.add_flag("--json", json, "write JSON instead of CSV");
}

void OutsideOption::add_to(CLI::App& verb) {
    CLI::Option* outside = verb.add_option_function<std::string>(
        "--outside",
        [this](const std::string& text) {
            policy = from_option("--outside", [&] { return spectral::outside_range_named(text); });
        },
        "beyond what is known of wavelengths and, of measured data,\ndirections: error (default), hold the "
        "end value, or zero");
    one_of(outside, {"error", "hold", "zero"});
    verb.add_flag_callback(
            "--clamp", [this] { policy = spectral::OutsideRange::hold; }, "the same as --outside hold")
        ->excludes(outside);
}

CLI::Option* MaterialOptions::add_to(CLI::App& verb) {
    outside.add_to(verb);
    return reads_whole(verb.add_option(material_names, path, "material file (JSON)"));
}

std::pair<std::string, double> assignment(const std::string& option, const std::string& text) {
    const auto at = text.find('=');
    if (at == std::string::npos) throw UsageError{option + ": " + text + ": must be name=value"};
    return {text.substr(0, at),
            from_option(option, [&] { return spectral::number_in(text.substr(at + 1)); })};
}

const std::string& MaterialOptions::text() const {
    if (!known_text) known_text = spectral::read_text_file(path);
    return *known_text;
}

spectral::Material MaterialOptions::read() const {
    auto material = spectral::material_from_text(text(), path, tables::models_with_files());
    for (const std::string& warning : material.warnings())
        std::cerr << "hts: " << path << ": " << warning << '\n';
    return material;
}

void warn_of_gain(const std::string& source, double reflectance) {
    if (reflectance > 1.005)
        std::cerr << source << ": WARNING: reflects " << brief(reflectance)
                  << " times the light that falls in\n";
}

void require_rough_surface(const spectral::Material& material, const std::string& option) {
    if (!material.properties().surface) refuse_model(material, option);
}

void require_polarised(const spectral::Material& material, const std::string& option) {
    if (!material.properties().polarised) refuse_model(material, option);
}

void ToleranceOption::add_to(CLI::App& verb) {
    verb.add_option("--tolerance", value, "relative error of materials of model he, 1e-12 (default) ... 1")
        ->check(number_within(hts::accuracy::finest_tolerance, hts::accuracy::coarsest_tolerance));
}

Tolerance ToleranceOption::tolerance() const {
    return Tolerance{value.value_or(hts::accuracy::finest_tolerance)};
}

void ToleranceOption::require_met_by(const spectral::Material& material) const {
    const auto& surface = material.properties().surface;
    if (!value || *value >= hts::accuracy::correlation_lobe || !surface || !surface->correlation()) return;
    throw UsageError{"--tolerance " + shortest(*value) + ": must be 1e-6 or more of " + material.name() +
                     ", whose correlation is not gaussian"};
}

Stokes stokes_from_option(const std::string& text) {
    if (text == "s") return Stokes::s_polarised();
    if (text == "p") return Stokes::p_polarised();
    if (text == "unpolarised") return Stokes::unpolarised();
    return from_option("--polarisation", [&] { return stokes_from_numbers(text); });
}

void require_angles(const std::string& option, const std::vector<double>& degrees) {
    for (const double angle : degrees) {
        from_option(option, [angle] { return Direction::from_degrees(angle, 0); });
    }
}

spectral::Reflectance reflectance_from_option(const std::string& option, const spectral::Material& material,
                                              const spectral::WavelengthGrid& wavelengths,
                                              const spectral::EvaluationOptions& how) {
    return spectral::located(option, [&] { return material.at(wavelengths, how); });
}

std::string json_of(const std::string& text) {
    return text.empty() || text.front() == '{' || text.front() == '"' ? text : json_string(text);
}

Wavelength wavelength_from_option(double um) {
    return from_option("--wavelength", [&] { return Wavelength::from_micrometres(um); });
}

spectral::WavelengthGrid wavelengths_from_option(const std::string& text) {
    return from_option("--wavelengths", [&] { return spectral::WavelengthGrid::parse(text); });
}

}  // namespace hts::cli
