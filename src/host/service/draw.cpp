#include "service/draw.h"

#include <fmt/format.h>

#include <iterator>
#include <span>
#include <utility>

#include "pictures/scene_loader.h"
#include "pictures/scene_studio.h"
#include "pipeline/import_again.h"
#include "ratings/ratings.h"
#include "service/device_worker.h"

namespace scene_analyzer::service {
namespace {

using pictures::Subject;

constexpr double kDrawingBegins = 0.95;  // of the job's progress

}  // namespace

std::string draw_picture(gpu::Device& device, Job& job, mesh::Scene scene,
                         const analysis::AssetAnalysis& analysis, std::vector<std::string>& messages) {
  const PictureOrder& order = *job.order().picture;
  const auto report = [&](double fraction, const std::string& step) {
    job.report(kDrawingBegins + (1 - kDrawingBegins) * fraction, step);
    if (job.is_given_up()) throw GivenUp();
  };
  pipeline::check_is_what_was_analysed(scene, analysis);
  const std::span assets(&analysis, 1);
  const ratings::SceneRating rating = ratings::rate(assets, order.rating);
  pictures::SceneStudio studio(device, {assets, rating, order.rating}, order.format);
  const bool groups = order.content.subject == Subject::kPlanarGroups;
  if (groups && !studio.can_draw_groups())
    messages.emplace_back(
        "the device cannot draw planar groups (geometryShader is missing): all meshes are grey");
  pictures::SceneLoader loader(device, job.options()->import_limits);
  loader.add(scene, analysis, groups && studio.can_draw_groups(), report);
  scene_render::SceneModel model = loader.finish();
  for (std::string& warning : loader.take_warnings()) messages.push_back(std::move(warning));
  studio.set_model(std::move(model));
  if (const auto far = studio.far_away())
    messages.push_back(
        fmt::format("{} lies so far from the other meshes that most of these are smaller than a pixel; "
                    "choose what is seen by eye and target",
                    studio.name_of(far->mesh)));
  report(1, "picture");
  return studio.draw(order.content, [&] {
    if (job.is_given_up()) throw GivenUp();
  });
}

}  // namespace scene_analyzer::service
