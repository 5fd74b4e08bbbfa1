#include "cli/verbs/table/mpi.hpp"

#ifdef HTS_MPI
#include <mpi.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "hts/error.hpp"
#include "tables/sharing/slice_file.hpp"
#endif

namespace hts::cli {

#ifdef HTS_MPI

namespace {

int rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int ranks() {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    return ranks;
}

/// The same text on all ranks.
std::string shared(std::string text) {
    std::uint64_t size = text.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    text.resize(size);
    MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
    return text;
}

/// One slice for each rank, the own of which is computed here; all of them arrive at the first. `first` is of
/// the whole list.
std::vector<double> gathered(const spectral::Reflectance& exact, const tables::TablePlan& plan,
                             const std::vector<std::uint64_t>& slices, std::size_t first,
                             std::size_t values) {
    const std::size_t own = first + static_cast<std::size_t>(rank());
    std::vector<double> mine(values);
    if (own < slices.size()) mine = tables::table_slice(exact, plan, slices[own]);
    std::vector<double> all(rank() == 0 ? values * static_cast<std::size_t>(ranks()) : 0);
    const int count = static_cast<int>(values);
    MPI_Gather(mine.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    return all;
}

/// What every rank does once the first has told it plan and slices.
template <class Keep>
void compute(const spectral::Reflectance& exact, const tables::TablePlan& plan,
             const std::vector<std::uint64_t>& slices, Keep&& keep) {
    const std::size_t values = plan.nodes.ratio * plan.nodes.turn * (plan.basis.size() / plan.floor.size());
    const auto step = static_cast<std::size_t>(ranks());
    for (std::size_t first = 0; first < slices.size(); first += step)
        keep(first, gathered(exact, plan, slices, first, values), values);
}

std::vector<std::uint64_t> shared(std::vector<std::uint64_t> list) {
    std::uint64_t size = list.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    list.resize(size);
    MPI_Bcast(list.data(), static_cast<int>(size), MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return list;
}

}  // namespace

Ranks::Ranks(const spectral::Reflectance& exact, const tables::TableJob& job) : exact_{exact}, job_{job} {
    MPI_Init(nullptr, nullptr);
    first_ = rank() == 0;
    if (first_) return;
    for (;;) {
        const std::string plan = shared(std::string{});
        if (plan.empty()) return;
        compute(exact, tables::header_from_bytes(plan, "plan").plan, shared(std::vector<std::uint64_t>{}),
                [](auto&&...) {});
    }
}

Ranks::~Ranks() {
    if (first_) static_cast<void>(shared(std::string{}));  // no more to come
    MPI_Finalize();
}

tables::SliceWorker Ranks::worker() {
    return [this](const tables::TablePlan& plan, std::span<const std::size_t> slices, const auto& keep) {
        // An error here would leave the others waiting for ever.
        const auto keep_or_abort = [&](std::size_t slice, const std::vector<double>& values) {
            try {
                keep(slice, values);
            } catch (const std::exception& error) {
                std::cerr << "hts: " << error.what() << '\n';
                MPI_Abort(MPI_COMM_WORLD, 1);
            }
        };
        static_cast<void>(shared(tables::part_header_bytes({job_, plan, {}})));
        const auto list = shared(std::vector<std::uint64_t>(slices.begin(), slices.end()));
        compute(exact_, plan, list,
                [&](std::size_t first, const std::vector<double>& all, std::size_t values) {
                    for (std::size_t i = 0; i * values < all.size() && first + i < list.size(); ++i) {
                        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i * values);
                        keep_or_abort(list[first + i], {begin, begin + static_cast<std::ptrdiff_t>(values)});
                    }
                });
    };
}

#else

Ranks::Ranks(const spectral::Reflectance& exact, const tables::TableJob& job) : exact_{exact}, job_{job} {}

Ranks::~Ranks() = default;

tables::SliceWorker Ranks::worker() {
    return tables::threads_worker(exact_);
}

#endif

}  // namespace hts::cli
