// Frames, kits, racers and laboratory drones. Makers' pages and papers, as remembered; the mass is that of a common
// build with battery.
#include "airsim360/flight/prompt/known_models.h"

namespace airsim360::internal {
namespace {

using Layout = RotorLayout;

constexpr std::string_view kPage = "maker's page, as remembered; mass of a common build";
constexpr std::string_view kMakersSheet = "maker's sheet, as remembered";

constexpr KnownModel kBuilderModels[] = {
    // aliases, title, class, rotors, layout, kg, mm, propeller and pitch in, cells, Ah, Wh, flight, hover, m/s
    {"x500|holybro x500|px4 x500|x500 v2|holybro x500 v2|px4 dev kit x500|x500v2|px4 x500 v2|holybro px4 dev kit", "Holybro X500",
     "frame_kit", 4, Layout::kX, 2.0, 500, 10, 4.5, 4, 5, 0, 0, 18, 0, "Holybro's page and PX4's Gazebo model x500"},
    {"s500|holybro s500|s500 v2|holybro s500 v2", "Holybro S500", "frame_kit", 4, Layout::kX, 1.5, 480, 10, 4.5, 4, 5, 0, 0, 18, 0, kPage},
    {"x650|holybro x650", "Holybro X650", "frame_kit", 4, Layout::kX, 3.5, 650, 15, 5.5, 6, 10, 0, 0, 0, 0, kPage},
    {"qav250|holybro qav250|qav 250|lumenier qav250", "Holybro QAV250", "racing", 4, Layout::kX, 0.65, 250, 5, 4.5, 4, 1.5, 0, 0, 0, 0,
     kPage},
    {"hexsoon edu 450|edu 450|hexsoon 450", "Hexsoon EDU-450", "frame_kit", 4, Layout::kX, 1.6, 450, 10, 4.5, 4, 5, 0, 0, 0, 0, kPage},
    {"hexsoon edu 650|edu 650|hexsoon td 650|td 650|hexsoon 650", "Hexsoon TD-650", "frame_kit", 4, Layout::kX, 3.3, 650, 15, 5.5, 6, 10, 0,
     0, 0, 0, kPage},
    {"tarot 650|tarot 650 sport|tarot fy650|tarot iron man 650", "Tarot 650", "frame_kit", 4, Layout::kX, 2.8, 650, 13, 5.5, 6, 8, 0, 0, 0,
     0, kPage},
    {"tarot 680|tarot 680 pro|tarot 680pro|tarot 690", "Tarot 680 Pro", "frame_kit", 6, Layout::kX, 3.5, 695, 13, 5.5, 6, 10, 0, 0, 0, 0,
     kPage},
    {"tarot 960|tarot t960", "Tarot T960", "heavy_lift", 6, Layout::kX, 6.5, 960, 18, 5.5, 6, 16, 0, 0, 0, 0, kPage},
    {"tarot x8|tarot x8 ii", "Tarot X8", "heavy_lift", 8, Layout::kX, 9, 1050, 15, 5.5, 6, 22, 0, 0, 0, 0, kPage},
    {"crazyflie|crazyflie 2|crazyflie 2.0|crazyflie 2.1|bitcraze crazyflie|crazyflie 2.x|bitcraze crazyflie 2.1|"
     "crazyflie 2.1 plus|cf2|cf2x",
     "Crazyflie 2.1", "nano", 4, Layout::kX, 0.027, 92, 1.8504, 0, 1, 0.25, 0, 7, 0, 0, "Bitcraze's page, as remembered"},
    {"crazyflie brushless|crazyflie 2.1 brushless|brushless crazyflie|bitcraze crazyflie brushless", "Crazyflie 2.1 Brushless",
     "nano_brushless", 4, Layout::kX, 0.041, 100, 2.165, 0, 1, 0.35, 0, 10, 0, 0, "Bitcraze's page, as remembered; with guards"},
    {"agilicious", "Agilicious", "racing", 4, Layout::kWideX, 0.752, 250, 5.1, 0, 4, 1.5, 0, 0, 0, 0, "Foehn et al. 2022"},
    {"qdrone|quanser qdrone|quanser", "Quanser QDrone", "research", 4, Layout::kX, 1.0, 0, 6, 0, 3, 3.3, 0, 0, 11, 0, kMakersSheet},
    {"qdrone 2|quanser qdrone 2", "Quanser QDrone 2", "research", 4, Layout::kX, 1.5, 0, 7, 0, 4, 3.7, 0, 0, 8, 0, kMakersSheet},
    {"starling|modalai starling|starling 2|modalai starling 2|voxl starling|starling max", "ModalAI Starling 2", "research", 4, Layout::kX,
     0.28, 211, 4.72, 0, 2, 3.6, 0, 0, 30, 0, kMakersSheet},
    {"voxl m500|m500|modalai m500|voxl|modalai", "ModalAI VOXL m500", "research", 4, Layout::kX, 1.075, 0, 10, 0, 4, 3.3, 0, 20, 0, 15,
     kMakersSheet},
    {"nxp hovergames|hovergames|nxp hovergames drone|kopis", "NXP HoverGames", "frame_kit", 4, Layout::kX, 1.2, 500, 10, 4.5, 4, 5, 0, 0, 0,
     0, kPage},
    {"duckiedrone|duckietown drone|dd21", "Duckiedrone", "research", 4, Layout::kX, 0.6, 250, 5, 4.5, 3, 1.5, 0, 0, 0, 0, kPage},
    {"coex clover|clover 4|coex clover 4", "COEX Clover 4", "frame_kit", 4, Layout::kX, 1.0, 0, 5, 4.5, 4, 2.3, 0, 0, 12, 0, kPage},
    {"nazgul|iflight nazgul|nazgul 5|nazgul5|iflight nazgul5|nazgul evoque|nazgul f5|iflight nazgul 5|nazgul5 v2|"
     "iflight nazgul5 v2|nazgul5 v3|iflight nazgul5 v3",
     "iFlight Nazgul5", "freestyle", 4, Layout::kX, 0.6, 240, 5, 4.3, 6, 1.4, 0, 0, 0, 0, kPage},
    {"iflight chimera7|chimera 7|chimera7|iflight chimera 7|chimera7 pro", "iFlight Chimera7", "survey", 4, Layout::kX, 1.1, 327, 7, 4, 6,
     3, 0, 20, 0, 0, kPage},
    {"meteor 65|betafpv meteor65|meteor65|betafpv meteor 65", "BetaFPV Meteor65", "whoop", 4, Layout::kX, 0.03, 65, 1.22, 0, 1, 0.3, 0, 0,
     0, 0, kPage},
    {"meteor 75|betafpv meteor75|meteor75|betafpv meteor 75", "BetaFPV Meteor75", "whoop", 4, Layout::kX, 0.037, 75, 1.575, 0, 1, 0.45, 0,
     0, 0, 0, kPage},
    {"pavo20|betafpv pavo20|pavo 20|betafpv pavo 20", "BetaFPV Pavo20", "cinematic", 4, Layout::kX, 0.15, 90, 2.2, 0, 3, 0.55, 0, 0, 0, 0,
     kPage},
    {"betafpv cetus|cetus|cetus pro|betafpv cetus pro", "BetaFPV Cetus", "whoop", 4, Layout::kX, 0.035, 77, 1.575, 0, 1, 0.45, 0, 5, 0, 0,
     kPage},
    {"tinyhawk|emax tinyhawk|tiny hawk|tinyhawk 2|tinyhawk ii|tinyhawk iii|tinyhawk s|tinyhawk 3", "Emax TinyHawk", "whoop", 4, Layout::kX,
     0.044, 75, 1.575, 0, 1, 0.45, 0, 4, 0, 0, kPage},
    {"mobula 6|mobula6|happymodel mobula6", "Happymodel Mobula6", "whoop", 4, Layout::kX, 0.028, 65, 1.22, 0, 1, 0.3, 0, 0, 0, 0, kPage},
    {"mobula 7|mobula7|happymodel mobula7", "Happymodel Mobula7", "whoop", 4, Layout::kX, 0.044, 75, 1.575, 0, 2, 0.3, 0, 0, 0, 0, kPage},
    {"iflight protek35|protek 35|protek35", "iFlight Protek35", "cinematic", 4, Layout::kX, 0.42, 151, 3.5, 0, 6, 1.05, 0, 0, 0, 0, kPage},
};

}  // namespace

std::span<const KnownModel> BuilderModels() { return kBuilderModels; }

}  // namespace airsim360::internal
