// Lists former names of settings, each with the present name.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace ogc::tests {

struct Renamed {
  std::string_view before, now;
  std::string refusal() const {
    return "unknown setting '" + std::string(before) + "': it is called " + std::string(now);
  }
};

inline constexpr std::array<Renamed, 15> renamed_settings{{
    {"activation", "contact_activation"},
    {"bound_relaxation", "bounds_relaxation"},
    {"colours", "reference_vbd_colours"},
    {"contact", "body_contact"},
    {"contact_blocks", "reference_vbd_contact_blocks"},
    {"contact_set", "reference_contact_set"},
    {"cut_after", "reference_vbd_cut_after"},
    {"friction_solves", "newton_friction_solves"},
    {"orientation", "rod_orientation"},
    {"projection", "newton_projection"},
    {"query_radius_cap", "detection_radius_cap"},
    {"redetect_every", "detection_every"},
    {"redetect_fraction", "detection_fraction"},
    {"start_frames", "rod_start"},
    {"truncation", "newton_truncation"},
}};

}  // namespace ogc::tests
