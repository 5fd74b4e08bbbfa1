#include "tables/formats/points/tracepro.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/angular_grid.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

using spectral::same_letters;

constexpr std::string_view signature = "TracePro Surface Property Data", table_mark = "Table_BSDF_Data";
constexpr double room_temperature = 293.15;  // [K]

struct Line {
    std::size_t number;
    std::vector<std::string_view> words;
};

/// Columns with names, and rows of as many numbers.
class Columns {
  public:
    Columns(std::string file, Line head) : file_{std::move(file)}, head_{std::move(head)} {}

    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
        for (std::size_t i = 0; i < head_.words.size(); ++i)
            if (same_letters(head_.words[i], name)) return i;
        return std::nullopt;
    }
    [[nodiscard]] std::size_t column(std::string_view name) const {
        if (const auto found = find(name)) return *found;
        throw Error{place(head_.number) + ": column " + std::string{name} + ": missing"};
    }
    void add(const Line& line) {
        if (line.words.size() != head_.words.size())
            throw Error{place(line.number) + ": " + std::to_string(line.words.size()) + " numbers: must be " +
                        std::to_string(head_.words.size()) + ", as there are columns"};
        spectral::located(place(line.number), [&] {
            for (const std::string_view word : line.words) numbers_.push_back(spectral::number_in(word));
        });
        lines_.push_back(line.number);
    }
    [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
    [[nodiscard]] std::size_t line(std::size_t row) const { return lines_[row]; }
    [[nodiscard]] double at(std::size_t row, std::size_t column) const {
        return numbers_[row * head_.words.size() + column];
    }
    /// The same, within a range.
    [[nodiscard]] double at(std::size_t row, std::size_t column, double least, double most) const {
        const double value = at(row, column);
        if (value >= least && value <= most) return value;
        throw Error{place(lines_[row]) + ": " + std::string{head_.words[column]} + " " + shortest(value) +
                    ": must be from " + shortest(least) + " to " + shortest(most)};
    }
    [[nodiscard]] std::string place(std::size_t line) const { return file_ + ":" + std::to_string(line); }

  private:
    std::string file_;
    Line head_;
    std::vector<double> numbers_;
    std::vector<std::size_t> lines_;
};

/// Surface data, and the table where there is one.
struct Parts {
    std::optional<Columns> surface{}, table{};
};

Parts parts_of(std::string_view text, const std::string& name) {
    Parts parts;
    Columns* open = nullptr;
    bool in_table = false;
    std::size_t number = 0;
    for (const std::string_view raw : spectral::split(text, '\n')) {
        Line line{++number, spectral::words(raw)};
        if (line.words.empty()) continue;
        if (same_letters(line.words[0], table_mark)) {
            in_table = true;
            open = nullptr;
        } else if (same_letters(line.words[0], "Temperature")) {
            auto& part = in_table ? parts.table : parts.surface;
            if (part) throw Error{name + ":" + std::to_string(number) + ": columns stand twice"};
            open = &part.emplace(name, std::move(line));
        } else if (open != nullptr) {
            open->add(line);
        } else if (in_table) {
            throw Error{name + ":" + std::to_string(number) +
                        R"(: must be the names of columns, "Temperature Wavelength IncAngle …")"};
        }
    }
    return parts;
}

/// The temperature nearest to that of a room.
double temperature_of(const Columns& columns, std::vector<std::string>& notes) {
    std::set<double> all;
    for (std::size_t row = 0; row < columns.size(); ++row)
        all.insert(columns.at(row, columns.column("Temperature"), 0, 1e6));
    const double nearest =
        *std::ranges::min_element(all, {}, [](double kelvin) { return std::abs(kelvin - room_temperature); });
    if (all.size() > 1)
        notes.push_back("data at " + std::to_string(all.size()) + " temperatures: those at " +
                        shortest(nearest) + " K are taken");
    return nearest;
}

/// Values by wavelength, azimuth and polar angle of the light, ScatterAzimuth, ScatterBeta.
using Key = std::array<double, 5>;

class Table {
  public:
    explicit Table(std::string name) : name_{std::move(name)} {}

    void add(const Key& key, double value, std::size_t line) {
        if (value < 0) negative_.note(value, line);
        value = std::max(value, 0.0);
        const auto [found, fresh] = values_.emplace(key, value);
        if (!fresh && found->second != value)
            throw Error{name_ + ":" + std::to_string(line) +
                        ": the directions of an earlier row again: must have one value"};
        for (std::size_t i = 0; i < key.size(); ++i) axes_[i].insert(key[i]);
    }

    [[nodiscard]] TraceProFile made(std::vector<std::string> notes) const {
        AngularGrid grid;
        grid.axis = PolarAxis::mirror_sine;
        const auto list = [&](std::size_t axis) {
            return std::vector<double>{axes_[axis].begin(), axes_[axis].end()};
        };
        grid.phi_i = list(1);
        grid.theta_i = list(2);
        grid.azimuth = list(3);
        grid.polar = list(4);
        grid.symmetric = grid.azimuth.back() <= 180;
        const auto wavelengths =
            spectral::located(name_, [&] { return spectral::WavelengthGrid::from_micrometres(list(0)); });
        double nodes = 1;
        for (const auto& axis : axes_) nodes *= static_cast<double>(axis.size());
        if (nodes > 1000.0 * static_cast<double>(values_.size())) throw lacking(nodes);
        std::vector<double> values;
        bool turned = false;  // whether the azimuth about the mirror direction means something
        for (const double phi : grid.phi_i)
            for (const double theta : grid.theta_i)
                for (const double azimuth : grid.azimuth)
                    for (const double beta : grid.polar)
                        for (const double um : axes_[0]) {
                            values.push_back(value({um, phi, theta, azimuth, beta}, nodes));
                            if (beta > 0)
                                turned = turned || values.back() !=
                                                       value({um, phi, theta, grid.azimuth[0], beta}, nodes);
                        }
        notes.push_back(std::to_string(values_.size()) +
                        " values about the mirror direction: linear in angles and in ScatterBeta between "
                        "them");
        if (turned)
            notes.emplace_back(
                "ScatterAzimuth 0 is taken to point away from the normal, which the format leaves open "
                "(--mirror-azimuth 180: towards it)");
        if (negative_.count > 0) notes.push_back(negative_.text());
        return {gridded_brdf(name_, wavelengths, std::move(grid), std::move(values)), std::move(notes)};
    }

  private:
    [[nodiscard]] Error lacking(double nodes) const {
        return Error{name_ + ": " + std::to_string(values_.size()) + " values: must be " + shortest(nodes) +
                     ", one for each of its wavelengths, angles and ScatterBeta"};
    }
    /// Along the normal the light has one azimuth, in the mirror direction the view.
    [[nodiscard]] double value(Key key, double nodes) const {
        auto found = values_.find(key);
        if (found == values_.end() && key[2] == 0) {
            key[1] = *axes_[1].begin();
            found = values_.find(key);
        }
        if (found == values_.end() && key[4] == 0) {
            key[3] = *axes_[3].begin();
            found = values_.find(key);
        }
        if (found == values_.end()) throw lacking(nodes);
        return found->second;
    }

    std::string name_;
    std::map<Key, double> values_;
    std::array<std::set<double>, 5> axes_;
    NegativeValues negative_;
};

double in_turn(double degrees) {
    return degrees - 360 * std::floor(degrees / 360);
}

TraceProFile file_of_table(const Columns& columns, const std::string& name, double outwards,
                           std::vector<std::string> notes) {
    const std::size_t um = columns.column("Wavelength"), theta = columns.column("IncAngle"),
                      beta = columns.column("ScatterBeta"), brdf = columns.column("BRDF");
    const auto phi = columns.find("AziAngle"), azimuth = columns.find("ScatterAzimuth"),
               btdf = columns.find("BTDF");
    if (columns.size() == 0) throw Error{name + ": no values below " + std::string{table_mark}};
    const double kelvin = temperature_of(columns, notes);
    std::set<double> azimuths;
    for (std::size_t row = 0; row < columns.size() && azimuth; ++row)
        azimuths.insert(in_turn(columns.at(row, *azimuth, -360, 360) - outwards));
    const bool on_one_side = std::ranges::all_of(azimuths, [](double a) { return a == 0 || a >= 180; });
    Table table{name};
    bool transmits = false;
    for (std::size_t row = 0; row < columns.size(); ++row) {
        if (columns.at(row, columns.column("Temperature")) != kelvin) continue;
        double turn = azimuth ? in_turn(columns.at(row, *azimuth) - outwards) : 0;
        if (on_one_side && turn > 0) turn = 360 - turn;  // the other side is the same
        table.add({columns.at(row, um, 1e-3, 1e6), phi ? in_turn(columns.at(row, *phi, -360, 360)) : 0,
                   columns.at(row, theta, 0, 90), turn, columns.at(row, beta, 0, 2)},
                  columns.at(row, brdf, -largest_number, largest_number), columns.line(row));
        transmits = transmits || (btdf && columns.at(row, *btdf) != 0);
    }
    if (transmits) notes.emplace_back("has a BTDF: left out");
    return table.made(std::move(notes));
}

/// A/(B + beta^g) at each direction of the light.
TraceProFile file_of_coefficients(const Columns& columns, const std::string& name,
                                  std::vector<std::string> notes) {
    const std::size_t um = columns.column("Wavelength"), theta = columns.column("IncAngle"),
                      a = columns.column("BRDF_A"), b = columns.column("BRDF_B"),
                      g = columns.column("BRDF_g");
    const auto by = columns.find("BRDF_By"), gy = columns.find("BRDF_gy"), phi = columns.find("AziAngle");
    if (columns.size() == 0) throw Error{name + ": no rows of surface data"};
    const double kelvin = temperature_of(columns, notes);
    Table table{name};
    for (std::size_t row = 0; row < columns.size(); ++row) {
        if (columns.at(row, columns.column("Temperature")) != kelvin) continue;
        const double scale = columns.at(row, a, 0, largest_number);
        if (scale == 0)
            throw Error{columns.place(columns.line(row)) + ": BRDF_A 0: must be > 0 in a file without " +
                        std::string{table_mark}};
        if ((by && columns.at(row, *by) != 0 && columns.at(row, *by) != columns.at(row, b)) ||
            (gy && columns.at(row, *gy) != 0 && columns.at(row, *gy) != columns.at(row, g)))
            throw Error{columns.place(columns.line(row)) + ": elliptical ABg: is not read; export the table"};
        const double knee = columns.at(row, b, 1e-30, largest_number), power = columns.at(row, g, 0, 20);
        const auto add = [&](double beta) {
            table.add({columns.at(row, um, 1e-3, 1e6), phi ? in_turn(columns.at(row, *phi, -360, 360)) : 0,
                       columns.at(row, theta, 0, 90), 0, beta},
                      scale / (knee + std::pow(beta, power)), columns.line(row));
        };
        constexpr double steps = 320;
        add(0);
        for (double k = 0; k <= steps; ++k) add(2 * std::pow(1e-6, 1 - k / steps));
    }
    notes.emplace_back("A, B and g of ABg: A/(B + ScatterBeta^g)");
    return table.made(std::move(notes));
}

}  // namespace

bool is_tracepro_file(std::string_view text) {
    return spectral::trimmed(text).starts_with(signature);
}

TraceProFile tracepro_file(std::string_view text, const std::string& name, double outwards) {
    const Parts parts = parts_of(text, name);
    if (!parts.surface && !parts.table)
        throw Error{name + R"(: no columns: must have a line "Temperature Wavelength IncAngle …")"};
    std::vector<std::string> notes;
    if (parts.surface) {
        double most = 0;
        for (const char* column : {"Refl_S", "Refl_P"})
            if (const auto found = parts.surface->find(column))
                for (std::size_t row = 0; row < parts.surface->size(); ++row)
                    most = std::max(most, parts.surface->at(row, *found));
        if (most > 0)
            notes.push_back("has a specular reflectance of up to " + spectral::brief(most, 3) +
                            ", which is no part of a BRDF: left out");
    }
    return parts.table ? file_of_table(*parts.table, name, outwards, std::move(notes))
                       : file_of_coefficients(*parts.surface, name, std::move(notes));
}

}  // namespace hts::tables
