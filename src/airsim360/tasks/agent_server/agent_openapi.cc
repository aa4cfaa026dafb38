#include "airsim360/tasks/agent_server/agent_api.h"

namespace airsim360 {

namespace {

// Checked by agent_api_test: it is JSON, and every path of it is answered.
constexpr std::string_view kAgentOpenApi = R"json({
"openapi": "3.0.3",
"info": {"title": "airsim360 agent", "version": "1",
  "description": "Navigation episodes for vision-language(-action) models. Metres, seconds, radians; fields in degrees end in _deg. World: x east, y north, z up. Azimuth grows to the right of the heading, elevation up. A connection, and an episode, has one request at a time. Over the WebSocket at /v1/ws each message is {\"id\", \"method\", \"path\", \"body\"} and is answered with {\"id\", \"status\", \"body\"} (pictures: \"content_type\" and base64 \"data\")."},
"paths": {
  "/": {"get": {"summary": "What this server is", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "name, world, worlds, realtime"}}}},
  "/openapi.json": {"get": {"summary": "This description", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "OpenAPI 3.0"}}}},
  "/v1/tasks": {"get": {"summary": "Episodes that can be asked for by name", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{tasks: [{task, world, world_seed, instruction}]}"}}}},
  "/v1/episodes": {
    "get": {"summary": "Open episodes", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episodes: [{episode, world}], most}"}}},
    "post": {"summary": "Create an episode", "requestBody": {"content": {"application/json": {"schema": {"$ref": "#/components/schemas/Create"}}}},
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "201": {"description": "{episode, world, task, observation}"}, "422": {"$ref": "#/components/responses/Error"}}}},
  "/v1/episodes/{id}": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Task, state and score", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episode, world, task, observation, score}"}}},
    "delete": {"summary": "Forget the episode", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{deleted}"}}}},
  "/v1/episodes/{id}/reset": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "post": {"summary": "Back to the start; with a seed, as if created with it", "requestBody": {"content": {"application/json": {"schema": {"type": "object", "additionalProperties": false, "properties": {"seed": {"type": "integer", "minimum": 0}, "observe": {"$ref": "#/components/schemas/Observe"}}}}}},
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episode, task, observation}"}}}},
  "/v1/episodes/{id}/step": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "post": {"summary": "Fly one action to its end", "requestBody": {"content": {"application/json": {"schema": {"type": "object", "required": ["action"], "additionalProperties": false, "properties": {"action": {"$ref": "#/components/schemas/Action"}, "observe": {"$ref": "#/components/schemas/Observe"}}}}}},
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episode, observation, score (when done), latency (in real time)}"}, "409": {"description": "the episode is busy"}, "422": {"$ref": "#/components/responses/Error"}}}},
  "/v1/episodes/{id}/observe": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "post": {"summary": "Look without acting", "requestBody": {"content": {"application/json": {"schema": {"$ref": "#/components/schemas/Observe"}}}},
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episode, observation, score (when done)}"}}}},
  "/v1/episodes/{id}/panorama.jpg": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Equirectangular picture", "parameters": [
      {"name": "width", "in": "query", "schema": {"type": "integer", "minimum": 16, "maximum": 4096, "default": 1024}},
      {"name": "quality", "in": "query", "schema": {"type": "integer", "minimum": 1, "maximum": 100, "default": 90}},
      {"name": "frame", "in": "query", "schema": {"type": "string", "enum": ["level", "body"], "default": "level"}}],
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "JPEG", "content": {"image/jpeg": {}}}}}},
  "/v1/episodes/{id}/view.jpg": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Perspective picture to one direction", "parameters": [
      {"name": "azimuth_deg", "in": "query", "schema": {"type": "number", "minimum": -360, "maximum": 360, "default": 0}},
      {"name": "elevation_deg", "in": "query", "schema": {"type": "number", "minimum": -90, "maximum": 90, "default": 0}},
      {"name": "fov_deg", "in": "query", "schema": {"type": "number", "minimum": 1, "maximum": 170, "default": 90}},
      {"name": "width", "in": "query", "schema": {"type": "integer", "minimum": 16, "maximum": 2048, "default": 512}},
      {"name": "height", "in": "query", "schema": {"type": "integer", "minimum": 16, "maximum": 2048, "default": 384}},
      {"name": "quality", "in": "query", "schema": {"type": "integer", "minimum": 1, "maximum": 100, "default": 90}}],
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "JPEG", "content": {"image/jpeg": {}}}}}},
  "/v1/episodes/{id}/range_grid": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Nearest range of each sector of the sphere; row 0 looks highest, column 0 straight behind, then on to the right; null = sky", "parameters": [
      {"name": "rows", "in": "query", "schema": {"type": "integer", "minimum": 1, "maximum": 64, "default": 8}},
      {"name": "columns", "in": "query", "schema": {"type": "integer", "minimum": 1, "maximum": 128, "default": 16}}],
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{rows, columns, range: [[metres or null]]}"}}}},
  "/v1/episodes/{id}/watch": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "For those who look on: the episode after the last request of its agent, which it neither holds nor changes", "parameters": [
      {"name": "width", "in": "query", "schema": {"type": "integer", "minimum": 16, "maximum": 4096, "default": 1024}},
      {"name": "quality", "in": "query", "schema": {"type": "integer", "minimum": 1, "maximum": 100, "default": 90}},
      {"name": "labels", "in": "query", "schema": {"type": "integer", "minimum": 0, "maximum": 1, "default": 0}},
      {"name": "since", "in": "query", "schema": {"type": "integer", "minimum": -1, "default": -1}, "description": "number of a moment that is known: answered without a picture while it is the newest"}],
      "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{episode, world, task, observation, score (when done), number, panorama: {width, height, data}, range and entity (base64 of float32 and uint32, row by row)}"}}}},
  "/v1/episodes/{id}/entities": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Names of the ids of its world", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{id: {name, category_path, kind}}"}}}},
  "/v1/episodes/{id}/path": {"parameters": [{"$ref": "#/components/parameters/id"}],
    "get": {"summary": "Places flown through, every 0.1 s", "responses": {"default": {"$ref": "#/components/responses/Error"}, "200": {"description": "{period, p: [[x, y, z]]}"}}}}
},
"components": {
  "parameters": {"id": {"name": "id", "in": "path", "required": true, "schema": {"type": "string"}}},
  "responses": {"Error": {"description": "What is wrong, where, and the nearest thing that would do", "content": {"application/json": {"schema": {"type": "object", "properties": {"error": {"type": "object", "required": ["message"], "properties": {"field": {"type": "string"}, "message": {"type": "string"}, "nearest": {"type": "string"}}}}}}}}},
  "schemas": {
    "Vector": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3},
    "Create": {"type": "object", "additionalProperties": false, "properties": {
      "task": {"type": "string", "description": "name of a task of the server; then nothing else but observe is given, and goal, distance_to_goal and goal_direction are null, unless the server tells them"},
      "world": {"type": "string"}, "world_seed": {"type": "integer", "minimum": 0},
      "instruction": {"type": "string", "maxLength": 4096}, "goal": {"$ref": "#/components/schemas/Vector"},
      "start": {"type": "object", "additionalProperties": false, "properties": {"p": {"$ref": "#/components/schemas/Vector"}, "yaw_deg": {"type": "number"}}},
      "reference_path": {"type": "array", "maxItems": 4096, "items": {"$ref": "#/components/schemas/Vector"}},
      "seed": {"type": "integer", "minimum": 0, "default": 0}, "drone": {"type": "string", "default": "hummingbird"},
      "success": {"type": "object", "additionalProperties": false, "properties": {"rule": {"type": "string", "enum": ["stop", "reach"], "default": "stop"}, "radius": {"type": "number", "description": "default 20 in the open, 1 in rooms"}}},
      "speed": {"type": "number", "default": 3},
      "presets": {"type": "object", "additionalProperties": false, "properties": {"forward": {"type": "number", "default": 5}, "lateral": {"type": "number", "default": 5}, "vertical": {"type": "number", "default": 2}, "turn_deg": {"type": "number", "default": 15}, "hover": {"type": "number", "default": 1}}},
      "limits": {"type": "object", "additionalProperties": false, "properties": {"max_steps": {"type": "integer", "default": 500}, "max_seconds": {"type": "number", "default": 600}, "end_on_collision": {"type": "boolean", "default": true}}},
      "observe": {"$ref": "#/components/schemas/Observe"}}},
    "Observe": {"type": "object", "additionalProperties": false, "properties": {
      "panorama": {"oneOf": [{"type": "boolean"}, {"type": "object", "additionalProperties": false, "properties": {"width": {"type": "integer", "default": 1024}, "quality": {"type": "integer", "default": 90}, "frame": {"type": "string", "enum": ["level", "body"]}}}]},
      "views": {"type": "array", "maxItems": 8, "items": {"type": "object", "additionalProperties": false, "properties": {"azimuth_deg": {"type": "number"}, "elevation_deg": {"type": "number"}, "fov_deg": {"type": "number", "default": 90}, "width": {"type": "integer", "default": 512}, "height": {"type": "integer", "default": 384}, "quality": {"type": "integer", "default": 90}}}},
      "range_grid": {"oneOf": [{"type": "boolean"}, {"type": "object", "additionalProperties": false, "properties": {"rows": {"type": "integer", "default": 8}, "columns": {"type": "integer", "default": 16}}}]}}},
    "Action": {"oneOf": [
      {"type": "string", "enum": ["stop", "hover", "forward", "backward", "left", "right", "up", "down", "turn_left", "turn_right"]},
      {"type": "object", "additionalProperties": false, "properties": {"type": {"type": "string", "enum": ["preset"]}, "name": {"type": "string"}}},
      {"type": "object", "additionalProperties": false, "required": ["type", "distance"], "properties": {"type": {"type": "string", "enum": ["relative_goal"]}, "azimuth_deg": {"type": "number"}, "elevation_deg": {"type": "number"}, "distance": {"type": "number"}, "speed": {"type": "number"}, "face": {"type": "boolean", "default": true}}},
      {"type": "object", "additionalProperties": false, "required": ["type", "points"], "properties": {"type": {"type": "string", "enum": ["waypoints"]}, "points": {"type": "array", "minItems": 1, "maxItems": 256, "items": {"$ref": "#/components/schemas/Vector"}}, "frame": {"type": "string", "enum": ["world", "body"], "default": "world"}, "speed": {"type": "number"}, "face": {"type": "boolean", "default": true}}},
      {"type": "object", "additionalProperties": false, "required": ["type", "v"], "properties": {"type": {"type": "string", "enum": ["velocity"]}, "v": {"$ref": "#/components/schemas/Vector"}, "frame": {"type": "string", "enum": ["body", "world"], "default": "body"}, "yaw_rate_deg": {"type": "number"}, "duration": {"type": "number", "default": 0.5, "maximum": 60}}},
      {"type": "object", "additionalProperties": false, "required": ["type", "w", "throttle"], "properties": {"type": {"type": "string", "enum": ["rates"]}, "w": {"$ref": "#/components/schemas/Vector"}, "throttle": {"type": "number", "minimum": 0, "maximum": 1}, "duration": {"type": "number", "default": 0.1, "maximum": 60}}}]}
  }
}
})json";

}  // namespace

std::string_view AgentOpenApi() { return kAgentOpenApi; }

}  // namespace airsim360
