#pragma once

#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"
#include "planner/world/obstacle.hpp"
#include "planner/world/raster_file.hpp"
#include "planner/world/terrain.hpp"
#include "planner/world/world.hpp"

/// What a scenario file says, validated (scenario/read.hpp) but not yet built (scenario/load.hpp). Defaults
/// stand here and nowhere else. Angles are radians here and degrees in the file; paths of files are made
/// absolute to where the scenario file stands.
namespace swallowtail::planner {

struct FlatTerrain {
  double elevation_m = 0.0;
};
struct MountainTerrain {
  std::vector<Mountain> mountains;
  std::optional<double> cell_size_m;  ///< chosen from bounds and spreads when left out
};
struct RasterTerrain {
  std::string file;
  std::optional<double> no_data_elevation_m;
};
using TerrainSpec = std::variant<FlatTerrain, MountainTerrain, RasterTerrain>;

/// Energy units per second in each phase of flight. The default is the document's model: one unit per second
/// aloft [COV 3].
struct EnergyRates {
  double level_per_s = 1.0;
  double climb_per_s = 1.0;
  double descent_per_s = 1.0;
  double hover_per_s = 1.0;
  double landed_per_s = 0.0;
  double altitude_per_m = 0.0;  ///< share by which all of them aloft grow per metre above altitude_from_m
  double altitude_from_m = 0.0;
};

/// A multirotor's power instead of the rates aloft; coverage/energy works it out and gives the source.
struct MultirotorSpec {
  double mass_kg = 3.0;  ///< without payload
  double payload_kg = 0.0;
  int rotors = 4;
  double rotor_radius_m = 0.2;
  double drag_area_m2 = 0.04;
  double solidity = 0.1;
  double blade_drag = 0.012;
  double tip_speed_mps = 80.0;
  double induced_factor = 1.15;
  double efficiency = 0.75;
  double avionics_w = 10.0;
  double air_density_kgpm3 = 1.225;
  double air_speed_max_mps = 20.0;
  double unit_j = 3600.0;  ///< joules in a unit of the battery's energy
};

struct VehicleSpec {
  std::uint32_t id = 1;
  VehicleLimits limits;
  EnergyRates energy;
  std::optional<MultirotorSpec> multirotor{};
};

struct PlanningSpec {
  std::string algorithm = "boa";
  int waypoints = 6;                                    ///< between start and goal
  std::string cost = "default";                         ///< a preset of cost/preset.hpp
  std::vector<std::pair<std::string, double>> weights;  ///< by objective name, instead of the preset's
  std::optional<Vec2> altitude_m;                       ///< least and greatest height above ground
};

struct HeightSpec {
  double default_m = 20.0;                ///< above ground
  std::map<std::string, double> classes;  ///< value of a feature's property `class` → metres above ground
};

struct BatterySpec {
  double capacity = 500.0;
  int levels = 10;
  double reserve = 25.0;
  double charge_s_per_unit = 2.0;
  double taper_from = 1.0;      ///< share of the capacity above which charging slows down; 1: never
  double taper_end_rate = 0.1;  ///< share of the charging rate that is left when full
};

/// Where the ground robot may drive.
struct RoadSpec {
  std::string file;                 ///< GeoJSON lines; coverage/ground reads it
  double off_road_speed_mps = 0.0;  ///< 0: it does not leave the road
  double off_road_max_m = 200.0;
};
struct RoughGroundSpec {
  double slope_max_rad = 0.35;
  std::string forbidden_file;  ///< polygons; empty: none
  double cell_m = 2.0;
};

/// The ground robot's own, which it refills at start_m.
struct RobotBatterySpec {
  double capacity = 0.0;     ///< units
  double drive_per_s = 0.0;  ///< units for each second that it drives
  double per_charged = 1.0;  ///< units for each that the aircraft is charged with
  double refill_s = 0.0;
  double reserve = 0.0;  ///< that it keeps
};

struct ChargerSpec {
  std::uint32_t id = 1;
  double speed_mps = 1.6;
  double take_off_s = 5.0;
  double landing_s = 5.0;
  Vec2 start_m = Vec2::Zero();
  std::variant<std::monostate, RoadSpec, RoughGroundSpec> ground{};  ///< monostate: anywhere, straight
  std::optional<RobotBatterySpec> battery{};                         ///< none: its energy has no end
};

/// What becomes of a band along a field's border.
enum class HeadlandUse { kNone, kSkip, kFly };

struct CoverageSpec {
  std::string fields_file;             ///< GeoJSON; coverage/field reads it
  std::vector<std::string> field_ids;  ///< which of its features; empty: all
  std::optional<Vec2> place_at_m;      ///< where the centre of the fields' bounding box is moved to
  double sensor_width_m = 10.0;
  HeightSpec heights;
  double height_tolerance_m = 2.0;  ///< a sub-cell is cut where the required altitude leaves this band
  double height_band_m = 0.0;       ///< layers' epsilon [COV 4.1]
  int neighbours = 5;               ///< X [COV 4.1]
  std::string no_fly_file;          ///< polygons neither covered nor crossed; empty: none
  double overlap = 0.0;             ///< share of the sensor's width that neighbouring strips see both
  std::optional<double> sweep_rad;  ///< flying direction, counter-clockwise from east; none: the cheapest
  HeadlandUse headland = HeadlandUse::kNone;
  double headland_m = 0.0;            ///< its width
  bool lines_beyond_borders = false;  ///< lines may leave the field over slanted borders
  std::optional<double> ceiling_m;    ///< greatest lawful height above ground
  BatterySpec battery;
  ChargerSpec charger;
};

struct WindSpec {
  double speed_mps = 0.0;
  double direction_rad = 0.0;  ///< where it blows to, clockwise from north
  double gust_mps = 0.0;       ///< greatest deviation from speed_mps
};

struct ObstacleAppears {
  Obstacle obstacle;
};  ///< its state_time_s is the event's time
struct ObstacleMoves {
  std::uint32_t id = 0;
  Vec3 velocity_mps = Vec3::Zero();
};
struct ObstacleVanishes {
  std::uint32_t id = 0;
};
struct BatteryLoss {
  double energy = 0.0;
};
struct ChargerDelay {
  double delay_s = 0.0;
};

/// Of the robot's own battery.
struct ChargerLoss {
  double energy = 0.0;
};

/// Another aircraft takes the place of the one that flies, under the same id, as soon as that has stood
/// on the ground for five seconds.
struct AircraftReplaced {
  std::optional<Vec2> start_m{};     ///< where it stands; none: where the mission starts
  std::optional<double> capacity{};  ///< of its battery; none: as that of the coverage says
  std::optional<double> energy{};    ///< that it holds; none: full
};

struct Event {
  double at_s = 0.0;
  std::variant<ObstacleAppears, ObstacleMoves, ObstacleVanishes, BatteryLoss, ChargerDelay, ChargerLoss,
               AircraftReplaced>
      what;
};

struct Scenario {
  std::string file;  ///< where it was read from
  std::string name;
  std::optional<GeoOrigin> origin;  ///< none: a purely local scene
  Bounds bounds;
  TerrainSpec terrain = FlatTerrain{};
  std::vector<Obstacle> obstacles;  ///< those known at t = 0
  VehicleSpec vehicle;
  std::optional<Vec3>
      start_m;  ///< always there with a goal; a coverage mission starts at the charger's start without it
  std::optional<Vec3> goal_m;
  PlanningSpec planning;
  std::optional<CoverageSpec> coverage;  ///< a goal, a coverage or both are there
  WindSpec wind;
  double battery_noise = 0.0;  ///< standard deviation of the power drawn, as a share of it
  std::vector<Event> events;   ///< in time
};

}  // namespace swallowtail::planner
