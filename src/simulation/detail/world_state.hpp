// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What changes a world's data: the parts of a tick, by the file that has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/optics.hpp"
#include "simulation/detail/changing_data.hpp"
#include "simulation/detail/world_model.hpp"

namespace carpus::simulation {

struct World::State : detail::ChangingData {
  explicit State(const Model& model);

  void step(const Model& model, const Input& raw) noexcept;
  void open(const Model& model) noexcept;

  // world.cpp
  [[nodiscard]] HandInput checked(std::size_t hand, const HandInput& raw) noexcept;
  void emit(EventKind kind, std::uint8_t item, std::int32_t detail, double value) noexcept;

  // checkpoints.cpp
  void save_checkpoint() noexcept;
  void forget_checkpoints() noexcept;
  void undo(const Model& model) noexcept;
  void return_to_step(const Model& model, std::uint8_t step) noexcept;
  void go_back_to(const Model& model, std::size_t kept) noexcept;
  /// How many checkpoints there are up to the last one at which `step` was not done.
  [[nodiscard]] std::size_t checkpoint_before(std::size_t step) const noexcept;
  [[nodiscard]] std::uint32_t returnable_steps() const noexcept;

  // commands.cpp
  void obey(const Model& model, const Command& command) noexcept;
  void take(const Model& model, std::uint8_t hand, InstrumentIndex instrument) noexcept;
  void pick_up(const Model& model, std::uint8_t hand, std::uint8_t item) noexcept;
  void put_down(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] double stands_out_more_mm(const detail::Item& held,
                                          const detail::Item& wire) const noexcept;
  void read_gauge(const Model& model, std::uint8_t hand) noexcept;

  // wire_ends.cpp
  void pick_up_far_end(const Model& model, std::uint8_t hand, std::uint8_t item) noexcept;
  void draw_by_far_end(const Model& model, std::uint8_t hand) noexcept;
  void come_out_at_far_side(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] bool is_near_end_out(const Model& model, const detail::Item& item) const noexcept;
  [[nodiscard]] bool is_far_end_out(const Model& model, const detail::Item& item) const noexcept;
  [[nodiscard]] bool is_air_at(const Model& model,
                               const Vec3& point,
                               const Vec3& far) const noexcept;
  [[nodiscard]] bool is_shaft_out(const Model& model, const detail::Item& item) const noexcept;
  [[nodiscard]] bool is_in_air(const Model& model,
                               const detail::Item& item,
                               double travel_mm) const noexcept;

  // wire_bending.cpp
  void bend_wires(const Model& model) noexcept;
  void note_press(const Model& model, detail::Item& item) const noexcept;
  void bend_wire(const Model& model, std::uint8_t index) noexcept;
  void break_wire(const Model& model, std::uint8_t index, std::uint8_t body) noexcept;
  void let_go_of(const Model& model, std::uint8_t index) noexcept;
  void ride_on(const Model& model, detail::Item& item, std::uint8_t wire) noexcept;

  // fluoroscopy.cpp
  void take_shot(const Model& model, const Command& command) noexcept;
  void look_through(const Model& model, const CArmInput& raw) noexcept;
  void note_look(const Model& model,
                 double rotation_deg,
                 double tilt_deg,
                 procedure::Look look) noexcept;
  void note_what_shows(const Model& model, procedure::Shot& shot) const noexcept;
  void note_reamed(const Model& model, const detail::Item& item) noexcept;
  [[nodiscard]] double along_aim(const Model& model,
                                 double rotation_deg,
                                 double tilt_deg) const noexcept;
  void pulse(const Model& model) noexcept;

  // wrist_motion.cpp
  void move_wrist(const Model& model, const WristPose& raw) noexcept;
  void stop_wrist(const Model& model) noexcept;
  void pose_bodies(const Model& model) noexcept;
  void carry_fixed_items() noexcept;

  // pins.cpp
  [[nodiscard]] detail::BodySet bones_pinned(const Model& model) const noexcept;
  [[nodiscard]] std::uint8_t carrier(const Model& model) const noexcept;
  [[nodiscard]] bool is_wrist_pinned(const Model& model) const noexcept;
  [[nodiscard]] bool is_target_inside_another(const Model& model) const noexcept;
  void carry_target(const Model& model,
                    std::uint8_t with,
                    const detail::InBone& with_from_target) noexcept;
  void ease_carried(const Model& model) noexcept;

  // free_motion.cpp
  void move_free(const Model& model, std::uint8_t hand) noexcept;
  void turn_towards(detail::Item& item, const Vec3& shaft) noexcept;
  void chase(const Model& model, std::uint8_t hand, const Vec3& target) noexcept;
  void rest_or_engage(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] bool lead_through_sleeve(const Model& model, std::uint8_t hand) noexcept;
  struct Resolved {
    Vec3 tip;
    bool is_free = true;     ///< nothing was touched
    bool is_wedged = false;  ///< could not be pushed out within the bound
  };
  [[nodiscard]] Resolved push_out(const Model& model,
                                  std::uint8_t hand,
                                  Vec3 tip,
                                  const Vec3& shaft) noexcept;
  void look(std::uint8_t hand, const Vec3& tip, const Vec3& shaft) noexcept;
  struct Touched {
    std::uint8_t body = kNoBody;
    double distance_mm = 0.0;
    Vec3 normal_in_patient;
  };
  [[nodiscard]] Touched surface_at(const Vec3& point_in_patient) const noexcept;
  // surface_ahead.cpp
  [[nodiscard]] SurfaceAhead surface_ahead(const Vec3& front,
                                           double radius_mm,
                                           const Touched& surface) const noexcept;

  // line_motion.cpp
  void engage(const Model& model, std::uint8_t hand, const Touched& surface) noexcept;
  [[nodiscard]] double way_back_to_surface(std::uint8_t body,
                                           const detail::Item& item) const noexcept;
  void enter_target(const Model& model,
                    detail::Item& item,
                    std::uint8_t body,
                    double entry_at_mm) noexcept;
  void drive(const Model& model, std::uint8_t hand) noexcept;
  void note_tip(const Model& model, std::uint8_t index) noexcept;
  void cut(const Model& model, detail::Item& item) noexcept;
  void note_track(const detail::Item& item,
                  std::uint8_t body,
                  const Vec3& from_in_body,
                  const Vec3& to_in_body,
                  double radius_mm) noexcept;
  void steer(const Model& model, detail::Item& item, double advanced_mm) noexcept;
  void come_out(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] bool has_screw_in_target(const Model& model) const noexcept;
  // compression.cpp
  void compress(const Model& model, std::uint8_t index, double advanced_mm) noexcept;
  [[nodiscard]] double close_gap(const Model& model,
                                 detail::Item& screw,
                                 double closing_mm) noexcept;

  void seat(const Model& model, std::uint8_t index) noexcept;
  // turning.cpp
  [[nodiscard]] double torque_n_mm(const Model& model,
                                   const detail::Item& screw,
                                   Driver driver) const noexcept;
  [[nodiscard]] double holding_share_of(const Model& model,
                                        const detail::Item& item) const noexcept;
  [[nodiscard]] double density_hu(const Model& model, const Vec3& point_in_patient) const noexcept;
  [[nodiscard]] double density_ahead_hu(const Model& model,
                                        const detail::Item& item) const noexcept;

  // fragments.cpp
  void push_fragment(const Model& model, const detail::Item& item, double force_n) noexcept;
  void lead_fragment(const Model& model, std::uint8_t hand) noexcept;
  void displace_fragment(const Model& model,
                         std::uint8_t body,
                         const detail::InBone& by,
                         detail::BodySet others) noexcept;
  [[nodiscard]] procedure::FractureFacts fracture_now(const Model& model) const noexcept;
  [[nodiscard]] double way_in_target_mm(const Model& model,
                                        const detail::Item& item) const noexcept;
  [[nodiscard]] bool is_fragment_held(const Model& model, std::uint8_t body) const noexcept;
  /// By what a fragment is stopped.
  struct Blocked {
    Vec3 out;                ///< of that bone, Patient, unit
    double excess_mm = 0.0;  ///< deeper in it than it may be
    bool is_fragment = false;
  };
  [[nodiscard]] std::optional<Blocked> blocked_by_another(const Model& model,
                                                          std::uint8_t body,
                                                          const detail::Displacement& moved,
                                                          detail::BodySet others) const noexcept;
  [[nodiscard]] bool is_within_ligaments(const Model& model,
                                         std::uint8_t body,
                                         const detail::Displacement& moved) const noexcept;

  // structures.cpp
  struct Bare {
    Vec3 from;
    Vec3 to;
    double radius_mm = 0.0;
  };
  struct BareParts {
    std::array<Bare, 2> part;
    std::size_t count = 0;
  };
  void watch_structures(const Model& model) noexcept;
  void note_way_in(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void note_harm(std::uint8_t hand, std::size_t structure, double gap_mm, bool is_struck) noexcept;
  void note_sleeves(const Model& model) noexcept;
  [[nodiscard]] BareParts bare_parts(std::uint8_t index, double radius_mm) const noexcept;

  // scopes.cpp
  struct WayIn {
    Vec3 skin;
    Vec3 inwards;
    double capsule_mm = 0.0;
  };
  struct Wall {
    double depth_mm = 0.0;
    Vec3 out;
  };
  [[nodiscard]] bool enters_joints(const Model& model, const detail::Item& item) const noexcept;
  /// As the case's map has it.
  [[nodiscard]] WayIn marked_way(const Model& model, std::uint8_t portal) const noexcept;
  /// By which one goes in: the marked one, or as it was made.
  [[nodiscard]] WayIn way_in(const Model& model, std::uint8_t portal) const noexcept;
  /// nullptr where that is not made, or none are.
  [[nodiscard]] const detail::OwnWay* own_way(const Model& model,
                                              std::uint8_t portal) const noexcept;
  [[nodiscard]] bool is_open(const Model& model, std::uint8_t portal) const noexcept;
  /// Into which a portal leads.
  [[nodiscard]] std::uint8_t joint_of(const Model& model, std::uint8_t portal) const noexcept;
  [[nodiscard]] Vec3 led_by_portal(const Model& model,
                                   std::uint8_t hand,
                                   const Vec3& tip,
                                   const Vec3& shaft) const noexcept;
  [[nodiscard]] arthroscopy::OpenedSpace joint_space_at(const Model& model,
                                                        std::uint8_t joint,
                                                        const Vec3& point) const noexcept;
  [[nodiscard]] Wall wall_at(const Model& model, std::uint8_t hand, const Vec3& tip) const noexcept;
  void find_portals(const Model& model) noexcept;
  void follow_portal(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  [[nodiscard]] bool is_in_sight(const Model& model,
                                 std::uint8_t joint,
                                 const Vec3& eye,
                                 const Vec3& point) const noexcept;
  void look_at_points(const Model& model,
                      std::uint8_t joint,
                      const arthroscopy::Sight& sight) noexcept;
  void look_at_lesions(const Model& model,
                       std::uint8_t joint,
                       const arthroscopy::Sight& sight) noexcept;
  [[nodiscard]] std::uint8_t unanswered(const Model& model) const noexcept;
  void note_scope_look(std::uint8_t joint, const arthroscopy::Sight& sight) noexcept;
  [[nodiscard]] bool is_level(const Model& model, const arthroscopy::Sight& sight) const noexcept;
  [[nodiscard]] bool is_held_back(std::uint8_t hand, const detail::Item& item) const noexcept;
  void note_probing(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  [[nodiscard]] std::optional<arthroscopy::Sight> sight_of(const Model& model,
                                                           const detail::Item& item) const noexcept;
  void watch_scopes(const Model& model) noexcept;

  // tears.cpp
  [[nodiscard]] Vec3 unshifted(const Model& model,
                               std::uint8_t body,
                               const Vec3& at) const noexcept;
  [[nodiscard]] bool is_in_hole(const Model& model,
                                std::uint8_t joint,
                                const Vec3& at,
                                double radius_mm) const noexcept;
  [[nodiscard]] bool is_in_tear(const Model& model,
                                std::uint8_t joint,
                                const Vec3& at,
                                double radius_mm) const noexcept;
  [[nodiscard]] arthroscopy::InInterval interval_at(const Model& model,
                                                    std::uint8_t hand,
                                                    const Vec3& tip) const noexcept;

  // scope_conduct.cpp
  void watch_conduct(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void watch_capsule(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void watch_press(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  struct BonePlace {
    std::uint8_t body = kNoBody;
    Vec3 at;  ///< on its surface, Patient
  };
  [[nodiscard]] BonePlace bone_beside(const Model& model, const detail::Item& item) const noexcept;
  [[nodiscard]] bool is_cartilage_at(const Model& model,
                                     std::uint8_t body,
                                     const Vec3& at_in_bone) const noexcept;
  void note_scuff(std::uint8_t hand,
                  std::uint8_t body,
                  const Vec3& at,
                  procedure::Scuffing how) noexcept;

  // scope_exercises.cpp
  [[nodiscard]] Vec3 place_now(const Model& model, std::size_t point) const noexcept;
  void watch_drill(const Model& model) noexcept;
  [[nodiscard]] detail::DrillLook drill_look(const Model& model,
                                             const detail::Item& scope,
                                             const arthroscopy::Sight& sight) const noexcept;
  [[nodiscard]] bool sees(const Model& model,
                          std::uint8_t joint,
                          const arthroscopy::Sight& sight,
                          const Vec3& tip) const noexcept;

  // floating_bodies.cpp
  void move_loose_bodies(const Model& model) noexcept;
  void watch_jaws(const Model& model, std::uint8_t hand) noexcept;
  void close_jaws(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void let_go_of_loose(const Model& model, std::size_t which) noexcept;
  void carry_loose(const Model& model, std::size_t which) noexcept;
  [[nodiscard]] double radius_of(const Model& model, std::size_t loose) const noexcept;
  void float_loose(const Model& model, std::size_t which) noexcept;
  void publish_loose(const Model& model) noexcept;
  [[nodiscard]] bool is_seen_beside(const Model& model, std::uint8_t hand, const Vec3& at) noexcept;
  [[nodiscard]] bool is_seen_beside(const Model& model,
                                    std::uint8_t hand,
                                    std::uint8_t joint,
                                    const Vec3& at) noexcept;
  [[nodiscard]] Vec3 lesion_middle(const Model& model, std::size_t lesion) const noexcept;
  [[nodiscard]] procedure::LooseFacts loose_facts(const Model& model) const noexcept;

  // tissue_pieces.cpp
  struct PieceNow {
    Vec3 at;  ///< Patient, on the joint's wall
    Vec3 inwards;
    double height_mm = 0.0;
  };
  void take_tissue_away(const Model& model) noexcept;
  void look_at_patches(const Model& model) noexcept;
  [[nodiscard]] bool is_patch_seen(const Model& model,
                                   std::uint8_t hand,
                                   std::uint8_t patch) const noexcept;
  [[nodiscard]] PieceNow piece_now(const Model& model, std::size_t i) const noexcept;
  [[nodiscard]] bool is_behind_tuft(const Model& model,
                                    std::uint8_t joint,
                                    const Vec3& eye,
                                    const Vec3& point) const noexcept;
  [[nodiscard]] bool is_in_cut_disc(const Model& model,
                                    std::uint8_t joint,
                                    const Vec3& at,
                                    double radius_mm) const noexcept;
  void piece_came_off(const Model& model, std::size_t which) noexcept;
  void cut_disc_as_left(const Model& model) noexcept;
  void publish_pieces(const Model& model) noexcept;

  // shavers.cpp
  void run_shaver(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void note_shaver_harm(const Model& model,
                        std::uint8_t hand,
                        std::uint8_t joint,
                        const detail::MouthPlace& mouth) noexcept;
  [[nodiscard]] std::size_t piece_in_mouth(const Model& model,
                                           std::uint8_t joint,
                                           const detail::MouthPlace& mouth,
                                           double reach_mm) const noexcept;
  [[nodiscard]] bool is_running(const Model& model, std::uint8_t hand) const noexcept;
  void publish_shaving(const Model& model) noexcept;

  // punches_in_joint.cpp
  struct NearPiece {
    std::size_t which = 0;
    double distance_mm = 0.0;  ///< from the jaws' middle
  };
  void watch_punch(const Model& model, std::uint8_t hand) noexcept;
  void close_punch(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void bite_off(const Model& model, std::uint8_t hand, std::size_t which, double width_mm) noexcept;
  [[nodiscard]] NearPiece piece_by_jaws(const Model& model,
                                        std::uint8_t joint,
                                        const Vec3& middle) const noexcept;
  void publish_punches() noexcept;

  // fluid_in_joint.cpp
  void run_fluid(const Model& model) noexcept;
  void note_portals() noexcept;
  [[nodiscard]] detail::FluidAround around_fluid(const Model& model) noexcept;
  void bleed_into_joint(const Model& model, double ml_per_s) noexcept;
  void draw_fluid(double ml_per_s) noexcept;
  [[nodiscard]] bool is_clear_to(const Model& model, double far_mm) const noexcept;
  [[nodiscard]] bool is_clear_enough(const Model& model) const noexcept;
  void publish_fluid(const Model& model) noexcept;

  [[nodiscard]] procedure::ScopeFacts scope_facts(const Model& model) const noexcept;
  void publish_scope(const Model& model) noexcept;
  [[nodiscard]] procedure::ScopeRecord scope_record(const Model& model) const;

  // screws.cpp
  [[nodiscard]] Wall metal_at(const Model& model,
                              std::uint8_t hand,
                              const Vec3& tip,
                              const Vec3& shaft) const noexcept;
  [[nodiscard]] std::uint8_t sites_seen() const noexcept;
  [[nodiscard]] procedure::ScrewFacts screw_facts(const Model& model) const noexcept;
  void probe_screw(const Model& model, std::uint8_t hand, const detail::Item& item) noexcept;
  void note_screw_answer(const Model& model, std::size_t asked) noexcept;

  // skin_contact.cpp
  [[nodiscard]] bool works_on_skin(const Model& model, const detail::Item& item) const noexcept;
  [[nodiscard]] Vec3 as_scanned(const Model& model, const Vec3& at) const noexcept;
  [[nodiscard]] Vec3 as_it_lies(const Model& model, const Vec3& scanned) const noexcept;
  [[nodiscard]] double way_to_hand(const Model& model, const Vec3& scanned) const noexcept;
  [[nodiscard]] double hand_share(const Model& model, const Vec3& scanned) const noexcept;
  [[nodiscard]] detail::SkinPlace skin_at(const Model& model, const Vec3& at) const noexcept;
  void move_on_skin(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] Vec3 wished_on_skin(const Model& model,
                                    const Vec3& tip,
                                    const Vec3& wish) const noexcept;
  void move_over_skin(const Model& model, std::uint8_t hand) noexcept;
  void follow_wish(detail::Item& item, const Vec3& to, double most_mm) noexcept;
  void publish_skin(const Model& model) noexcept;

  // palpation.cpp
  [[nodiscard]] double bone_below_mm(const Vec3& skin,
                                     const Vec3& normal,
                                     double deepest_mm) const noexcept;
  [[nodiscard]] FeltView felt_at(const Model& model, const detail::SkinPlace& at) noexcept;
  [[nodiscard]] double sinks_in_mm(const Model& model,
                                   const detail::SkinPlace& at,
                                   double share) noexcept;
  void note_felt(const Model& model, const detail::SkinPlace& at) noexcept;
  [[nodiscard]] Vec3 landmark_now(const Model& model, std::size_t which) const noexcept;

  // under_skin.cpp
  void move_under_skin(const Model& model, std::uint8_t hand) noexcept;
  void advance_under_skin(const Model& model, std::uint8_t hand, double to_mm) noexcept;
  [[nodiscard]] double held_back_n(const Model& model, std::uint8_t hand) const noexcept;
  [[nodiscard]] Vec3 on_cut(const Model& model, std::uint8_t cut, const Vec3& at) const noexcept;
  [[nodiscard]] double cut_length(const Model& model, std::uint8_t cut) const noexcept;
  void slip_into_cut(const Model& model, detail::UnderSkin& under) const noexcept;
  [[nodiscard]] std::uint8_t cut_at(const Model& model,
                                    const Vec3& at,
                                    double radius_mm) const noexcept;
  [[nodiscard]] std::optional<std::uint8_t> joint_at(const Model& model,
                                                     const Vec3& at) const noexcept;
  void come_into_skin(const Model& model, std::uint8_t hand, const Vec3& entry) noexcept;
  void leave_skin(std::uint8_t hand) noexcept;
  void spread_way(const Model& model, std::uint8_t hand) noexcept;

  // portal_making.cpp
  [[nodiscard]] std::size_t asked_now() const noexcept;
  void ink(const Model& model, const Vec3& at) noexcept;
  void cut_skin(const Model& model, std::uint8_t hand, const detail::SkinPlace& at) noexcept;
  void watch_blade(const Model& model, std::uint8_t hand, const detail::SkinPlace& at) noexcept;
  void watch_making(const Model& model, std::uint8_t hand) noexcept;
  void note_line_in(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] bool is_from_its_side(const Model& model,
                                      std::size_t asked,
                                      const Vec3& towards) const noexcept;
  void note_strayed(const Model& model,
                    std::size_t asked,
                    const Vec3& at,
                    const Vec3& towards) noexcept;
  void note_under(const Model& model, std::uint8_t hand) noexcept;
  void watch_needle(const Model& model, std::uint8_t hand) noexcept;
  [[nodiscard]] bool is_uncut(const detail::UnderSkin& under) const noexcept;
  [[nodiscard]] procedure::WayMade way_made(const Model& model,
                                            const detail::UnderSkin& under) const noexcept;
  [[nodiscard]] detail::OwnWay way_as_made(const Model& model,
                                           const detail::UnderSkin& under) const noexcept;
  [[nodiscard]] procedure::CutMade cut_made(const Model& model,
                                            const detail::UnderSkin& under) const noexcept;
  [[nodiscard]] procedure::MakingFacts making_facts(const Model& model) const noexcept;

  // yielding_sheets.cpp
  void lay_sheets(const Model& model) noexcept;
  void find_sheets(const Model& model) noexcept;
  [[nodiscard]] yielding::Tip tip_on(const Model& model,
                                     const detail::YieldingSheet& sheet,
                                     const detail::Item& item,
                                     const Vec3& tip) const noexcept;
  [[nodiscard]] UnderTip under_tip(const Model& model,
                                   std::uint8_t s,
                                   const yielding::Tip& tip) const noexcept;
  [[nodiscard]] std::optional<Wall> sheet_at(const Model& model,
                                             std::uint8_t hand,
                                             const Vec3& tip_in_patient,
                                             const Vec3& wall_outwards) const noexcept;
  void yield_sheets(const Model& model) noexcept;
  void sink_in(const Model& model, std::uint8_t hand, const yielding::Tip& tip) noexcept;
  void publish_sheets(const Model& model) noexcept;

  // disc_hook.cpp
  [[nodiscard]] bool is_by_edge(const Model& model, std::uint8_t hand) noexcept;
  void hook_disc(const Model& model, std::array<yielding::Tip, kHands>& tips) noexcept;
  void let_go_of_disc(const Model& model) noexcept;
  [[nodiscard]] Vec3 hook_force(const Model& model, std::size_t hand) const noexcept;

  // steps.cpp
  void tick_off_steps(const Model& model) noexcept;
  struct Facts {
    std::array<procedure::LineFacts, kMaxItems> lines;
    procedure::Situation situation;
  };
  void gather(const Model& model, Facts& facts) const noexcept;
  [[nodiscard]] procedure::LineFacts facts_of(const Model& model,
                                              const detail::Item& item) const noexcept;

  // publishing.cpp
  void publish(const Model& model) noexcept;
  void publish_state(const Model& model) noexcept;
  void publish_item(const Model& model, std::size_t index) noexcept;
  void publish_hand(const Model& model, std::size_t hand) noexcept;
  void update_hash(const Model& model) noexcept;

  [[nodiscard]] detail::Item* in_hand(std::size_t hand) noexcept {
    const std::uint8_t index = now.held[hand];
    return index < kMaxItems ? &now.items[index] : nullptr;
  }
  [[nodiscard]] const instruments::Instrument& kind_of(const Model& model,
                                                       const detail::Item& item) const noexcept {
    return model.catalogue[item.instrument];
  }
  /// Tail of a screw below the surface at its entry [mm].
  [[nodiscard]] double buried_mm(const Model& model, const detail::Item& item) const noexcept {
    return item.depth_mm() - kind_of(model, item).length_mm;
  }
  [[nodiscard]] Vec3 entry_in_bone(const detail::Item& item) const noexcept {
    return item.origin_in_bone + item.direction_in_bone * item.entry_at_mm;
  }
};

}  // namespace carpus::simulation
