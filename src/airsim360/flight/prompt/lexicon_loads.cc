// Things that drones carry; their masses where a maker publishes them.
#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {
namespace {
using enum WordKind;

// Masses in kg are those of the makers' sheets, as remembered, without lenses, mounts and cables.
constexpr Word kLoadWords[] = {
    {kLoad, 0, "camera",
     "hasselblad camera|full frame camera|camera|cameras|gimbal camera|camera gimbal|cam|cams|dslr|mirrorless|mirrorless camera"},
    {kLoad, 0, "",
     "gimbal|gimbals|spray can|paint can|lidar|laser scanner|sensor|sensors|parcel|parcels|package|packages|box|cargo box|medicine|pizza|"
     "thermal camera|depth camera|stereo camera|multispectral camera|multispectral sensor|hyperspectral camera|"
     "zoom camera|cinema camera|360 camera|speaker|speakers|loudspeaker|loud speaker|megaphone|computer|"
     "companion computer|companion|onboard computer|deck|bait|seed|seeds|defibrillator|aed|magnetometer|radar|"
     "winch|parachute|robot arm|robotic arm|manipulator arm|gripper arm|canopy|banner|cake|bottle|soda|laptop|kit bag|first aid kit|drop kit|rescue kit|medical kit|survival kit|medicines|drugs|vials|turkey|burger|sandwich|battery bank|flowers|hasselblad|manipulator|gripper|spotlight|searchlight|light|lights|instrument|instruments|"
     "equipment|gear|camera rig|gopro rig|samples|sample|sampler|blood|vaccines|supplies|groceries|hook|"
     "sling load|slung load|fire extinguisher|hose|extinguishing balls|microphone|net|mortar|optics|pod|"
     "sensor head|sensor package|sensor suite|camera package|stuff|goods|food|books|bomb|lens|load|loads|lifebuoy|"
     "life ring|rope|tool|tools|module|modules|phone|tablet|vr camera|mail|letter|bag|coffee|beer|meal|meals"},
    {kLoad, 0, "liquid", "liquid|tank|pesticides|herbicide|water|fertilizer|chemical|chemicals|solution|granules|spray tank|hopper"},
    {kLoad, 0.153, "",
     "gopro|go pro|gopro hero|hero 9|hero 10|hero 11|hero 12|gopro hero 9|gopro hero 10|"
     "gopro hero 11|gopro hero 12|action camera|action cam|osmo action|full size gopro"},
    {kLoad, 0.028, "", "naked gopro"},
    {kLoad, 0.149, "", "insta360 one r|insta360|insta 360|insta360 x3|insta360 x4"},
    {kLoad, 0.95, "", "red komodo|komodo"},
    {kLoad, 1.5, "", "red epic|red dragon|red raven|red gemini|red helium|red monstro|red camera"},
    {kLoad, 2.3, "", "alexa mini|arri alexa mini|arri alexa|alexa mini lf|arri"},
    {kLoad, 0.63, "", "sony a7|sony a7s|sony a7 iii|sony a7s iii|a7s|a7s iii|a7 iii|sony a7 3|a7siii|sony alpha 7"},
    {kLoad, 0.665, "", "sony a7r|sony a7r iv|a7r iv|sony a7r iii|a7r"},
    {kLoad, 0.404, "", "sony a6000|sony a6300|sony a6400|a6000|a6400"},
    {kLoad, 0.77, "", "sony fx3|fx3"},
    {kLoad, 0.68, "", "canon r5|canon eos r5|canon 5d|canon eos"},
    {kLoad, 0.9, "", "blackmagic pocket|bmpcc|blackmagic"},
    {kLoad, 0.83, "", "zenmuse h20t|h20t|zenmuse h20|zenmuse h30|zenmuse h30t"},
    {kLoad, 0.93, "", "zenmuse l1|zenmuse l2"},
    {kLoad, 0.8, "", "zenmuse p1"},
    {kLoad, 0.545, "", "zenmuse x5|zenmuse x5s|zenmuse"},
    {kLoad, 0.63, "", "zenmuse x7|zenmuse xt2"},
    {kLoad, 0.35, "", "rx0|phase one small"},
    {kLoad, 0.231, "", "micasense rededge|rededge|micasense"},
    {kLoad, 0.072, "", "realsense|realsense d435|d435|d435i|d455|intel realsense|realsense d435i"},
    {kLoad, 0.06, "", "realsense t265|t265|oak d lite"},
    {kLoad, 0.115, "", "oak d|luxonis oak d"},
    {kLoad, 0.166, "", "zed 2|zed 2i|zed camera|stereolabs zed"},
    {kLoad, 0.265, "", "livox mid 360|mid 360|livox"},
    {kLoad, 0.76, "", "livox mid 70|mid 70"},
    {kLoad, 0.498, "", "livox avia|avia"},
    {kLoad, 0.83, "", "velodyne|vlp 16|velodyne vlp 16|velodyne puck|puck"},
    {kLoad, 0.59, "", "puck lite|vlp 16 lite|velodyne puck lite"},
    {kLoad, 0.447, "", "ouster os0|ouster os1|ouster|os1|os0"},
    {kLoad, 0.13, "", "hokuyo|hokuyo ust 10lx|ust 10lx"},
    {kLoad, 0.19, "", "rplidar|rplidar a2|rplidar a1"},
    {kLoad, 0.136, "", "garmin lidar lite|tfmini"},
    {kLoad, 0.05, "", "flir lepton|lepton"},
    {kLoad, 0.11, "", "flir vue pro|vue pro|flir boson|flir"},
    {kLoad, 0.176, "", "jetson orin nx|orin nx|orin nano|jetson orin nano|jetson nano|jetson xavier nx|xavier nx|jetson"},
    {kLoad, 0.12, "", "jetson tx2|tx2"},
    {kLoad, 0.7, "", "jetson agx orin|agx orin|jetson agx xavier|agx xavier"},
    {kLoad, 0.046, "", "raspberry pi|raspberry pi 4|raspberry pi 5|rpi|pi 4"},
    {kLoad, 0.5, "", "intel nuc|nuc"},
};

}  // namespace

std::span<const Word> LoadWords() { return kLoadWords; }

}  // namespace airsim360::internal
