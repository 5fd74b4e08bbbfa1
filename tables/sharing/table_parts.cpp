#include "tables/sharing/table_parts.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/whole_file.hpp"
#include "tables/sharing/slice_file.hpp"

namespace hts::tables {
namespace {

namespace fs = std::filesystem;

fs::path slices_path(const fs::path& path) {
    return path.string() + ".slices";
}

/// Slices are needed until the file that holds them has its name.
void remove_when_done(const fs::path& slices) {
    if (auto* run = spectral::RunFiles::of_process()) return run->remove_at_end(slices);
    fs::remove(slices);
}

/// What an earlier go at the same job left.
std::optional<Part> left_behind(const fs::path& path, const TableJob& job, const TableShard& shard) {
    if (!fs::exists(path)) return std::nullopt;
    std::optional<Part> part;
    try {
        part = read_part(path);
    } catch (const Error& error) {
        if (is_header_cut_short(path)) return std::nullopt;  // the job starts anew
        throw Error{path.string() +
                    ": no finished slices of this job: must be removed first, if nobody needs it (" +
                    error.what() + ")"};
    }
    if (part->header.job == job && part->header.shard == shard) return part;
    throw Error{path.string() +
                ": holds finished slices of another job: must be removed first, or that job finished"};
}

/// The part beside the target, open for more slices.
class OpenPart {
  public:
    OpenPart(fs::path path, PartHeader header) : path_{std::move(path)}, header_{std::move(header)} {
        file_.open(path_, std::ios::binary | std::ios::trunc);
        append(part_header_bytes(header_));
    }
    OpenPart(fs::path path, Part part)
        : path_{std::move(path)}, header_{std::move(part.header)}, slices_{std::move(part.slices)} {
        fs::resize_file(path_, part.sound_bytes);
        file_.open(path_, std::ios::binary | std::ios::app);
    }

    [[nodiscard]] const PartHeader& header() const noexcept { return header_; }
    [[nodiscard]] std::vector<std::size_t> wanted() const {
        return header_.shard.slices(header_.plan.slices());
    }
    [[nodiscard]] std::vector<std::size_t> missing() const {
        std::vector<std::size_t> missing = wanted();
        std::erase_if(missing, [&](std::size_t slice) { return slices_.contains(slice); });
        return missing;
    }
    void keep(std::size_t slice, const std::vector<double>& values) {
        append(slice_bytes(slice, values));
        slices_[slice] = values;
    }
    [[nodiscard]] std::vector<std::vector<double>> take_slices() {
        std::vector<std::vector<double>> all;
        for (auto& [slice, values] : slices_) all.push_back(std::move(values));
        return all;
    }
    void close() { file_.close(); }

  private:
    void append(const std::string& bytes) {
        file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        file_.flush();
        if (!file_) {
            throw Error{path_.string() + ": cannot be written (" + std::strerror(errno) +
                        "): must be a file that can be written"};
        }
    }

    fs::path path_;
    PartHeader header_;
    std::map<std::size_t, std::vector<double>> slices_;
    std::ofstream file_;
};

OpenPart open_part(const spectral::Reflectance& exact, const TableJob& job, const fs::path& path,
                   const TableShard& shard, const TableProgress& progress) {
    if (auto part = left_behind(path, job, shard)) return {path, std::move(*part)};
    if (!fs::exists(path)) const spectral::Output writable{path.string()};  // before the work is done
    return {path, PartHeader{job, plan_table(exact, job.request, progress), shard}};
}

void fill(OpenPart& part, const SliceWorker& worker, const TableProgress& progress) {
    const std::vector<std::size_t> missing = part.missing();
    const double all = static_cast<double>(part.wanted().size());
    double done = all - static_cast<double>(missing.size());
    worker(part.header().plan, missing, [&](std::size_t slice, const std::vector<double>& values) {
        part.keep(slice, values);
        done += 1;
        if (progress) progress("filling", done / all);
    });
}

void require_shard(const TableShard& shard) {
    if (shard.count >= 1 && shard.number >= 1 && shard.number <= shard.count) return;
    throw Error{"shard " + std::to_string(shard.number) + "/" + std::to_string(shard.count) +
                ": must be k/N with k from 1 to N"};
}

std::size_t whole(std::string_view text) {
    std::size_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure == std::errc{} && end == text.data() + text.size()) return value;
    throw Error{"shard: " + spectral::in_quotes(text) + " is no whole number"};
}

/// All slices of a table from the parts, each job and plan the first one's.
class Merger {
  public:
    void add(const fs::path& path) {
        Part part = read_part(path);
        if (!first_) {
            first_ = part.header;
            first_path_ = path;
        } else if (!(part.header.job == first_->job) || !(part.header.plan == first_->plan) ||
                   part.header.shard.count != first_->shard.count) {
            throw Error{path.string() + ": is a part of another table than " + first_path_.string() +
                        ": must have its material, wavelengths, tolerance, seed and number of shards"};
        }
        for (auto& [slice, values] : part.slices) slices_[slice] = std::move(values);
    }
    [[nodiscard]] const PartHeader& header() const { return *first_; }
    [[nodiscard]] std::vector<std::vector<double>> slices() {
        std::set<std::string> lacking;
        std::vector<std::vector<double>> all;
        for (std::size_t slice = 0; slice < first_->plan.slices(); ++slice) {
            const auto found = slices_.find(slice);
            if (found == slices_.end()) {
                const std::string part = std::to_string(slice % first_->shard.count + 1);
                lacking.insert(part + "/" + std::to_string(first_->shard.count));
            } else {
                all.push_back(std::move(found->second));
            }
        }
        if (lacking.empty()) return all;
        throw Error{"part " + spectral::joined({lacking.begin(), lacking.end()}) +
                    " is missing or not finished: must be there, complete"};
    }

  private:
    std::optional<PartHeader> first_;
    fs::path first_path_;
    std::map<std::size_t, std::vector<double>> slices_;
};

}  // namespace

TableShard TableShard::from_text(std::string_view text) {
    const auto slash = std::min(text.find('/'), text.size());
    const TableShard shard{whole(text.substr(0, slash)),
                           whole(text.substr(std::min(slash + 1, text.size())))};
    require_shard(shard);
    return shard;
}

std::vector<std::size_t> TableShard::slices(std::size_t all) const {
    std::vector<std::size_t> own;
    for (std::size_t slice = number - 1; slice < all; slice += count) own.push_back(slice);
    return own;
}

spectral::Reflectance exact_model(const TableSource& source, std::span<const double> wavelengths_um,
                                  Tolerance tolerance) {
    if (source.material.empty()) throw Error{source.name + ": has no material file: must be built from one"};
    const auto grid =
        spectral::WavelengthGrid::from_micrometres({wavelengths_um.begin(), wavelengths_um.end()});
    return spectral::material_from_text(source.material, source.material_path, models_with_files())
        .at(grid, {.tolerance = tolerance, .outside = source.policy});
}

spectral::Reflectance exact_model(const TableJob& job) {
    const double tolerance = std::clamp(0.01 * job.request.tolerance, hts::accuracy::finest_tolerance,
                                        hts::accuracy::finest_lane_tolerance);
    return exact_model(job.source, job.wavelengths_um, Tolerance{tolerance});
}

SliceWorker threads_worker(const spectral::Reflectance& exact) {
    return [&exact](const TablePlan& plan, std::span<const std::size_t> slices, const auto& keep) {
        constexpr std::size_t at_once = 8;  // so many are kept before the next begin
        for (std::size_t from = 0; from < slices.size(); from += at_once) {
            const auto some = slices.subspan(from, std::min(at_once, slices.size() - from));
            std::vector<std::vector<double>> values(some.size());
            spectral::parallel_for(some.size(),
                                   [&](std::size_t i) { values[i] = table_slice(exact, plan, some[i]); });
            for (std::size_t i = 0; i < some.size(); ++i) keep(some[i], values[i]);
        }
    };
}

void build_table_file(const spectral::Reflectance& exact, const TableJob& job, const fs::path& path,
                      const TableShard& shard, const SliceWorker& worker, const TableProgress& progress) {
    require_shard(shard);
    const fs::path slices = slices_path(path);
    OpenPart part = open_part(exact, job, slices, shard, progress);
    if (shard.count > 1) {
        fill(part, worker, progress);
        part.close();
        spectral::write_file(path.string(), read_whole_file(slices));
        remove_when_done(slices);
        return;
    }
    const auto filled = [&](const TablePlan& plan) {
        if (!(plan == part.header().plan)) part = OpenPart{slices, PartHeader{job, plan, shard}};
        fill(part, worker, progress);
        if (progress) progress("measuring", 0);
        return part.take_slices();
    };
    const auto bytes = [&] {
        try {
            return finished_table(exact, job.source, part.header().plan, filled);
        } catch (const Error&) {
            part.close();
            if (part.missing().empty()) fs::remove(slices);  // going on from there would meet the same
            throw;
        }
    }();
    part.close();
    spectral::write_file(path.string(), bytes);
    remove_when_done(slices);
}

void merge_table_file(const std::vector<fs::path>& parts, const fs::path& path) {
    if (parts.empty()) throw Error{"parts of a table: must be at least one"};
    Merger merger;
    for (const fs::path& part : parts) merger.add(part);
    const PartHeader header = merger.header();
    const auto exact = exact_model(header.job);
    const auto of_parts = [&](const TablePlan& plan) {
        return plan == header.plan ? merger.slices() : computed_slices(exact)(plan);
    };
    spectral::write_file(path.string(), finished_table(exact, header.job.source, header.plan, of_parts));
}

}  // namespace hts::tables
