// parameters.h — Parameters of requests, checked, as what the rooms take. All throw service::Refusal
// (kInvalid) naming the field, its value and what is allowed.
#pragma once

#include <string>

#include "analysis/metric.h"
#include "pipeline/pipeline.h"
#include "ratings/ratings.h"
#include "rpc/backend.h"
#include "scene_analyzer/v1/service.pb.h"
#include "service/job.h"

namespace scene_analyzer::rpc {

// `default_metrics`: where the message names none.
pipeline::Options read_measuring(const v1::MeasuringParameters& message, analysis::MetricSet default_metrics,
                                 const Backend& backend);

ratings::Options read_rating(const v1::RatingParameters& message);

// Subject, colours and size of a picture, and how its scene is rated.
service::PictureOrder read_picture(const v1::RenderParameters& message);

// The metrics that the picture shows.
analysis::MetricSet metrics_of(const service::PictureOrder& picture);

// All but the rendering time, which must be asked for.
analysis::MetricSet quick_metrics();

}  // namespace scene_analyzer::rpc
