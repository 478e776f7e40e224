// device_worker.h — What is done with imported assets on the device, by one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "mesh/scene.h"
#include "pipeline/pending_pack.h"
#include "pipeline/pipeline.h"
#include "service/job.h"
#include "service/loss_record.h"
#include "service/metrics.h"

namespace scene_analyzer::service {

// Thrown by a job's progress when nobody waits for it; not a std::runtime_error, so that no handler of
// ordinary errors takes it.
class GivenUp : public std::exception {
 public:
  const char* what() const noexcept override { return "nobody waits for the result"; }
};

// An asset that is imported.
struct Imported {
  std::shared_ptr<Job> job;
  std::unique_ptr<pipeline::PendingAnalysis> analysis;
  mesh::Scene picture;               // with textures; where a picture was ordered
  std::uint64_t bytes = 0;           // of memory
  bool wants_quiet = false;          // is measured with nothing imported beside it
  std::uint64_t refused_before = 0;  // LossRecord::refused() when it was looked up there
};

// What a client is told.
Answer answer_of(pipeline::Outcome outcome, Metrics& metrics);

struct WorkerEvents {
  std::function<void(std::shared_ptr<Job> job)> try_again;  // from the beginning
  std::function<void(std::uint64_t bytes)> released;        // of what was imported
  std::function<void(const std::string& message)> error;    // for the log
};

class DeviceWorker {
 public:
  DeviceWorker(pipeline::Pipeline& pipeline, Metrics& metrics, WorkerEvents events);
  ~DeviceWorker();  // nobody gets an answer to what is left

  // Measures them together and finishes them, or leaves them pending while the host searches their start
  // triangles. Never throws: what goes wrong is the jobs' answer. What may have been a neighbour's fault,
  // such as a lost device, is tried again alone.
  void start(std::vector<Imported> imported);
  // Those whose search has ended, or nobody waits for.
  void finish_searched();
  void finish_all();
  std::size_t pending() const { return pending_.size(); }
  const LossRecord& losses() const { return losses_; }

 private:
  struct Pack {
    std::vector<std::shared_ptr<Job>> jobs;  // none where one is tried again
    std::vector<mesh::Scene> pictures;       // per job
    std::uint64_t bytes = 0;
    std::unique_ptr<pipeline::PendingPack> pending;

    bool is_given_up() const;
  };
  // Runs a step of a pack; false when it has ended with it.
  bool attempt(Pack& pack, const std::function<void()>& step);
  bool was_refused(const Imported& one);
  void record_loss(const mesh::AssetSource& asset);
  void finish(Pack& pack);
  void answer(Pack& pack, std::size_t index, pipeline::Outcome outcome);
  void draw(Job& job, mesh::Scene scene, Answer& answer);
  void lose(Pack& pack, const std::string& what);
  void try_again_or_refuse(const Pack& pack, bool is_at_fault, const std::string& what);
  void refuse_all(const Pack& pack, Reason reason, const std::string& what);

  pipeline::Pipeline& pipeline_;
  Metrics& metrics_;
  const WorkerEvents events_;
  std::list<std::unique_ptr<Pack>> pending_;
  LossRecord losses_;
};

}  // namespace scene_analyzer::service
