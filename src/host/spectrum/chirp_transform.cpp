#include "spectrum/chirp_transform.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>

#include "interface/spectrum.h"
#include "modulate_signals.spv.h"
#include "total_magnitudes.spv.h"
#include "write_chirps.spv.h"

namespace scene_analyzer::spectrum {

using namespace interface::spectrum;

namespace {

const gpu::Kernel& made(gpu::Device& device, gpu::Kernel& kernel, const std::string& name,
                        std::span<const std::uint32_t> words,
                        std::initializer_list<std::uint32_t> constants) {
  if (!kernel) kernel = device.make_kernel(name, words, {constants.begin(), constants.size()});
  return kernel;
}

std::string named(const char* name, bool even) {
  return std::string(name) + (even ? "_even" : "_odd");
}

// Arrays for one row, which names say what the device was asked for should it refuse.
std::vector<ComplexArray> make_windows(gpu::Device& device, const char* what, std::uint64_t samples,
                                       const RowForm& form, std::uint64_t elements) {
  std::vector<ComplexArray> windows;
  const std::string name = std::string(what) + " of " + std::to_string(samples) + " samples, part ";
  const std::string parts = " of " + std::to_string(form.windows);
  for (std::uint32_t i = 1; i <= form.windows; ++i)
    windows.emplace_back(device, name + std::to_string(i) + parts, elements);
  return windows;
}

}  // namespace

ChirpTransform::ChirpTransform(gpu::Device& device, std::uint32_t window, std::uint32_t batch)
    : device_(device), window_(window), batch_(std::min(batch, window)), convolution_(device, window) {}

const gpu::Kernel& ChirpTransform::modulate(bool even) {
  return made(device_, modulate_[even], named("modulate_signals", even), modulate_signals_spv, {even});
}
const gpu::Kernel& ChirpTransform::write_chirps(bool even) {
  return made(device_, write_chirps_[even], named("write_chirps", even), write_chirps_spv, {even});
}
const gpu::Kernel& ChirpTransform::total(bool even, std::uint32_t windows) {
  return made(device_, total_[{even, windows}], named("total_magnitudes", even), total_magnitudes_spv,
              {even, windows});
}

// 0: a signal and its chirp do not fit into one array.
std::uint32_t ChirpTransform::batch_rows(std::uint32_t row_length) const {
  const std::uint32_t rows = std::max(batch_ / row_length, 2U);
  return rows <= window_ / row_length ? rows : 0;
}

std::uint64_t ChirpTransform::workspace_elements(std::span<const Item> items) {
  std::uint64_t elements = 0;
  for (std::size_t first = 0; first < items.size();) {
    const std::uint32_t row_length = items[first].row_length;
    std::size_t end = first;
    while (end < items.size() && items[end].row_length == row_length) ++end;
    const std::uint64_t rows = std::min<std::uint64_t>(batch_rows(row_length), 2 * (end - first));
    if (rows > 0)
      elements = std::max(elements, convolution_.elements_for(rows, convolution_.form(row_length)));
    first = end;
  }
  return elements;
}

void ChirpTransform::run(std::span<const Signal> signals, Results results) {
  std::vector<Item> items;
  for (const Signal& signal : signals)
    items.push_back({.signal = signal, .row_length = RowConvolution::row_length(lags_of(signal))});
  std::ranges::sort(items, {}, [](const Item& item) {
    return std::tuple(item.row_length, is_even(item.signal), item.signal.samples.size(), item.signal.index);
  });
  const ComplexArray workspace(device_, "rows of spectra", workspace_elements(items));
  for (std::size_t first = 0; first < items.size();) {
    const Item& item = items[first];
    if (batch_rows(item.row_length) > 0) {
      first += run_batch(std::span(items).subspan(first), workspace, results);
    } else {
      run_long(item.signal, convolution_.form(item.row_length), results);
      ++first;
    }
  }
}

// As many of the first items as fit; returns how many.
std::size_t ChirpTransform::run_batch(std::span<const Item> items, const ComplexArray& workspace,
                                      Results results) {
  const bool even = is_even(items.front().signal);
  const RowForm form = convolution_.form(items.front().row_length);
  const std::uint32_t most_rows = batch_rows(form.elements());
  ChirpBatch batch(results);
  for (const Item& item : items) {
    if (is_even(item.signal) != even || item.row_length != form.elements()) break;
    if (batch.rows_with(item.signal) > most_rows) break;
    batch.add(item.signal);
  }
  const std::uint32_t signals = batch.signal_count(), chirps = batch.chirp_count();
  const ChirpBatch::OnDevice arrays = batch.upload(device_, signals);

  gpu::Recorder recorder(device_);
  const std::uint32_t groups_per_row = form.elements() / kRowElements;
  RowParams params{.groups = signals * groups_per_row,
                   .groups_per_row = groups_per_row,
                   .first_row = 0,
                   .first = 0,
                   .elements = form.elements(),
                   .shape = form.shape()};
  recorder.run_groups(modulate(even), params.groups, params,
                      {arrays.signals, arrays.phases, arrays.samples, workspace});
  params.groups = chirps * groups_per_row;
  params.first_row = signals;
  recorder.run_groups(write_chirps(even), params.groups, params, {arrays.chirps, arrays.phases, workspace});
  convolution_.record(recorder, form, arrays.signals, workspace, signals, chirps);
  record_totals(recorder, batch, arrays, form, even, {&workspace, 1});
  recorder.submit_and_wait();
  batch.finish(device_, arrays);
  return signals;
}

// A signal whose row, or that and its chirp's, is beyond one array.
void ChirpTransform::run_long(const Signal& signal, const RowForm& form, Results results) {
  const bool even = is_even(signal);
  ChirpBatch batch(results);
  batch.add(signal);
  const ChirpBatch::OnDevice arrays = batch.upload(device_, 0);
  const std::uint64_t elements =
      form.windows == 1 ? convolution_.elements_for(1, form) : form.elements_of_window();
  const auto rows = make_windows(device_, "row of a signal", signal.samples.size(), form, elements);
  const auto chirps = make_windows(device_, "row of a chirp", signal.samples.size(), form, elements);

  gpu::Recorder recorder(device_);
  const std::uint32_t groups = form.elements_of_window() / kRowElements;
  RowParams params{.groups = groups,
                   .groups_per_row = groups,
                   .first_row = 0,
                   .first = 0,
                   .elements = form.elements(),
                   .shape = form.shape()};
  for (std::size_t i = 0; i < rows.size(); ++i, params.first += form.elements_of_window()) {
    recorder.run_groups(modulate(even), groups, params,
                        {arrays.signals, arrays.phases, arrays.samples, rows[i]});
    recorder.run_groups(write_chirps(even), groups, params, {arrays.chirps, arrays.phases, chirps[i]});
  }
  recorder.submit_and_wait();
  convolution_.run(form, arrays.signals, rows, chirps);
  record_totals(recorder, batch, arrays, form, even, rows);
  recorder.submit_and_wait();
  batch.finish(device_, arrays);
}

void ChirpTransform::record_totals(gpu::Recorder& recorder, const ChirpBatch& batch,
                                   const ChirpBatch::OnDevice& arrays, const RowForm& form, bool even,
                                   std::span<const ComplexArray> rows) {
  const TotalParams params{.inverse_length = 1.0 / form.elements(),
                           .segments = static_cast<std::uint32_t>(arrays.segments.count()),
                           .write_magnitudes = batch.wants_magnitudes() ? 1U : 0U,
                           .window = form.elements_of_window(),
                           .shape = form.shape()};
  const auto nth = [&](std::size_t n) -> const ComplexArray& { return rows[std::min(n, rows.size() - 1)]; };
  recorder.run_groups(total(even, form.windows), params.segments, params,
                      {arrays.signals, arrays.phases, arrays.segments, nth(0), nth(1), nth(2), nth(3),
                       arrays.parts, arrays.magnitudes});
}

}  // namespace scene_analyzer::spectrum
