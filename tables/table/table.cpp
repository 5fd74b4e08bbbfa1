#include "tables/table/table.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstring>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "tables/table/table_contents.hpp"
#include "tables/table/table_lobe.hpp"

namespace hts::tables {
namespace {

/// e^y to 2e-7 relative, -80 <= y <= 80; beyond, e^-80 or e^80. Without branches, so
/// that compilers take lanes.
float exponential(float y) {
    constexpr float limit = 80, log2_e = 1.44269504F, ln2_high = 0.693359375F, ln2_low = -2.12194440e-4F;
    constexpr float to_integer = 0x1.8p23F;  // adding it rounds to a whole number
    y = y > limit ? limit : y;
    y = y < -limit ? -limit : y;
    const float shifted = y * log2_e + to_integer;
    const float whole = shifted - to_integer;
    const float r = (y - whole * ln2_high) - whole * ln2_low;
    const float series =
        1 + r * (1 + r * (1.F / 2 + r * (1.F / 6 + r * (1.F / 24 + r * (1.F / 120 + r * (1.F / 720))))));
    const auto power =
        std::bit_cast<float>(static_cast<std::int32_t>(static_cast<std::int32_t>(whole) + 127) << 23);
    return series * power;
}

double exponential(double y) {
    return std::exp(y);
}

/// Reads a one-dimensional spline of all wavelengths.
void spline_values(std::span<const double> coefficients, std::size_t nodes, double x,
                   std::span<double> values) noexcept {
    const SplinePlace place = spline_place(x, nodes);
    const double* c = coefficients.data() + place.first * values.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = 0;
        for (std::size_t k = 0; k < 4; ++k) values[i] += place.weights[k] * c[k * values.size() + i];
    }
}

// Compiled for several instruction sets, of which the loader takes the best that the processor has.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define HTS_TABLES_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), flatten))
#else
#define HTS_TABLES_CLONES
#endif

double lobe_value(auto logarithm, double floor) {
    const double value = static_cast<double>(exponential(logarithm)) - floor;
    return value > 0 ? value : 0;
}

template <class Real>
LobeSpline<Real> lobe_spline(const TableContents& contents, std::span<const Real> numbers) {
    const std::size_t components = contents.info.components, wavelengths = contents.numbers.floor.size();
    return {numbers.data(), numbers.data() + components * wavelengths, components, wavelengths};
}

template <class Real>
LobePlace<Real> place_of(const TableContents& contents, const DirectionPair& pair) {
    const auto& nodes = contents.info.nodes;
    return lobe_place<Real>(contents.map(pair), {nodes.grazing, nodes.ratio, nodes.turn});
}

template <class Real>
inline void write_lobe(const TableContents& contents, std::span<const Real> numbers,
                       const LobePlace<Real>& place, std::span<double> values) noexcept {
    const double* const floor = contents.numbers.floor.data();
    lobe_spline(contents, numbers).visit(place, [&](std::size_t first, const Real* logarithms, auto width) {
        std::array<Real, width> powers;  // apart from what may alias, so that compilers take lanes
        for (std::size_t i = 0; i < width; ++i) powers[i] = exponential(logarithms[i]);
        for (std::size_t i = 0; i < width; ++i)
            values[first + i] = std::max(0.0, static_cast<double>(powers[i]) - floor[first + i]);
    });
}

HTS_TABLES_CLONES void write_float_lobe(const TableContents& contents, const LobePlace<float>& place,
                                        std::span<double> values) noexcept {
    write_lobe(contents, contents.numbers.lobe, place, values);
}

HTS_TABLES_CLONES void write_double_lobe(const TableContents& contents, const LobePlace<double>& place,
                                         std::span<double> values) noexcept {
    write_lobe(contents, contents.numbers.fine_lobe, place, values);
}

bool above_horizon(const DirectionPair& pair) {
    return pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
}

void write_lobe(const TableContents& contents, const DirectionPair& pair, std::span<double> values) noexcept {
    if (!above_horizon(pair)) {
        std::ranges::fill(values, 0.0);
    } else if (contents.info.double_precision) {
        write_double_lobe(contents, place_of<double>(contents, pair), values);
    } else {
        write_float_lobe(contents, place_of<float>(contents, pair), values);
    }
}

/// A file mapped into memory for as long as it is held.
class Mapping {
  public:
    explicit Mapping(const std::filesystem::path& path) {
        const int file = ::open(spectral::path_to_read(path).c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) fail(path);
        struct stat status {};
        const bool regular = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
        size_ = regular ? static_cast<std::size_t>(status.st_size) : 0;
        if (size_ > 0) memory_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
        ::close(file);
        if (!regular || size_ == 0) throw Error{path.string() + ": must be a file that is not empty"};
        if (memory_ == MAP_FAILED) fail(path);
    }
    ~Mapping() {
        if (memory_ != MAP_FAILED) ::munmap(memory_, size_);
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;

    [[nodiscard]] std::string_view bytes() const noexcept {
        return {static_cast<const char*>(memory_), size_};
    }

  private:
    [[noreturn]] static void fail(const std::filesystem::path& path) {
        throw Error{path.string() + ": cannot be read (" + std::strerror(errno) + ")"};
    }
    void* memory_ = MAP_FAILED;
    std::size_t size_ = 0;
};

}  // namespace

Table Table::open(const std::filesystem::path& path) {
    auto mapping = std::make_shared<const Mapping>(path);
    const std::string_view bytes = mapping->bytes();
    return Table{
        std::make_shared<const TableContents>(contents_of(bytes, std::move(mapping), path.string()))};
}

Table Table::from_bytes(std::string bytes, const std::string& name) {
    auto owned = std::make_shared<const std::string>(std::move(bytes));
    const std::string_view view = *owned;
    return Table{std::make_shared<const TableContents>(contents_of(view, std::move(owned), name))};
}

Table::Table(std::shared_ptr<const TableContents> contents)
    : spectral::Evaluator{contents->info.source.name, contents->info.wavelengths},
      contents_{std::move(contents)} {}

const TableInfo& Table::info() const noexcept {
    return contents_->info;
}

std::size_t Table::bytes() const noexcept {
    return contents_->bytes;
}

std::string Table::checksum() const {
    std::array<char, 17> digits{};
    static_cast<void>(std::snprintf(digits.data(), digits.size(), "%016llx",
                                    static_cast<unsigned long long>(contents_->checksum)));
    return digits.data();
}

bool Table::covers(const DirectionPair& pair) noexcept {
    static const double lowest = std::cos(steepest_theta) * (1 - 1e-12);
    return pair.in.cos_theta() >= lowest && pair.out.cos_theta() >= lowest;
}

void Table::directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept {
    write_lobe(*contents_, pair, values);
}

void Table::brdf(const DirectionPair& pair, std::span<double> values) const noexcept {
    const auto uniform = contents_->numbers.uniform_diffuse;
    write_lobe(*contents_, pair, values);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += uniform[i];
}

void Table::brdf(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept {
    const std::size_t width = wavelengths().size();
    for (std::size_t i = 0; i < pairs.size(); ++i) brdf(pairs[i], values.subspan(i * width, width));
}

void Table::uniform_diffuse(std::span<double> values) const noexcept {
    std::ranges::copy(contents_->numbers.uniform_diffuse, values.begin());
}

void Table::specular_reflectance(const Direction& in, std::span<double> values) const noexcept {
    spline_values(contents_->numbers.specular, contents_->info.nodes.specular, contents_->map.grazing(in),
                  values);
    for (double& value : values) value = std::max(0.0, value);
}

void Table::diffuse_albedo(const Direction& in, std::span<double> values) const noexcept {
    spline_values(contents_->numbers.albedo, contents_->info.nodes.albedo, contents_->map.grazing(in),
                  values);
    const auto uniform = contents_->numbers.uniform_diffuse;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += uniform[i] * std::numbers::pi;
}

spectral::Properties Table::properties() const {
    return {.polarised = contents_->info.nodes.polarisation > 0, .specular_term = true, .isotropic = true};
}

void Table::mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept {
    directional_diffuse_mueller(pair, values);
    if (contents_->info.nodes.polarisation == 0) return;
    const auto uniform = contents_->numbers.uniform_diffuse;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[i] + Mueller::depolariser(uniform[i]);
}

void Table::directional_diffuse_mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept {
    if (contents_->info.nodes.polarisation == 0) return spectral::Evaluator::mueller(pair, values);
    const std::size_t width = values.size();
    const SplinePlace place =
        spline_place(wave_vector_change(pair.in, pair.out).cos_theta_d(), contents_->info.nodes.polarisation);
    const double* const first = contents_->numbers.polarisation.data() + place.first * 2 * width;
    const auto with_lobe = [&](const auto& spline, const auto& lobe_place) {
        spline.visit(lobe_place, [&](std::size_t from, const auto* logarithms, std::size_t count) {
            for (std::size_t i = from; i < from + count; ++i) {
                std::complex<double> ratio;
                for (std::size_t k = 0; k < 4; ++k) {
                    const double* const node = first + k * 2 * width;
                    ratio += place.weights[k] * std::complex<double>{node[i], node[width + i]};
                }
                const Mueller facet = Mueller::from_jones(facet_jones(pair.in, pair.out, {1, ratio}));
                const double lobe = lobe_value(logarithms[i - from], contents_->numbers.floor[i]);
                values[i] = (lobe / facet(0, 0)) * facet;
            }
        });
    };
    if (!above_horizon(pair)) {
        std::ranges::fill(values, Mueller{});
    } else if (contents_->info.double_precision) {
        with_lobe(lobe_spline(*contents_, contents_->numbers.fine_lobe), place_of<double>(*contents_, pair));
    } else {
        with_lobe(lobe_spline(*contents_, contents_->numbers.lobe), place_of<float>(*contents_, pair));
    }
}

spectral::Reflectance open_for_plan(const std::filesystem::path& path, const std::string& checksum) {
    const Table table = Table::open(path);
    if (table.checksum() == checksum) return table.reflectance();
    throw Error{path.string() + ": checksum " + table.checksum() + ": must be " + checksum +
                ", of the table that was planned; plan the scene again"};
}

}  // namespace hts::tables
