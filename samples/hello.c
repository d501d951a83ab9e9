/* The smallest bake: a room of twelve triangles, one lamp, the light at the corners of the room. */
#include <math.h>
#include <radvor.h>
#include <stdio.h>

/* Prints why a call failed. Zero and positive results are not failures. */
static int failed(const radvor_context* context, radvor_result result) {
  if (result < 0) {
    fprintf(stderr, "%s: %s\n", radvor_result_string(result), context ? radvor_context_error(context) : "no context");
  }
  return result < 0;
}

int main(void) {
  /* A room of 4 x 3 x 5 m, corners numbered by bits: 1 is +x, 2 is +y, 4 is +z. Fronts face inwards. */
  const float corners[8][3] = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {4, 3, 0}, {0, 0, 5}, {4, 0, 5}, {0, 3, 5}, {4, 3, 5}};
  const uint32_t triangles[12][3] = {
      {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6}, /* floor, ceiling */
      {0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, /* walls at z = 0 and z = 5 */
      {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}, /* walls at x = 0 and x = 4 */
  };
  radvor_context* context = NULL;
  radvor_scene* scene = NULL;
  radvor_solution* solution = NULL;
  radvor_material_desc white = {0};
  radvor_mesh_desc room = {0};
  radvor_light_desc lamp = {0};
  float irradiance[8][3] = {{0}};
  uint32_t material = 0, mesh = 0, light = 0;
  int bad;

  white.struct_size = sizeof white;
  white.albedo[0] = white.albedo[1] = white.albedo[2] = 0.7f;

  room.struct_size = sizeof room; /* every field not set has its default */
  room.vertex_count = 8;
  room.positions = corners[0];
  room.triangle_count = 12;
  room.indices = triangles[0];

  lamp.struct_size = sizeof lamp;
  lamp.type = RADVOR_LIGHT_POINT;
  lamp.position[0] = 2.0, lamp.position[1] = 2.5, lamp.position[2] = 2.5;
  lamp.color[0] = 10.0f, lamp.color[1] = 9.0f, lamp.color[2] = 7.0f; /* W sr^-1 */

  bad = failed(NULL, radvor_context_create(NULL, &context)) || failed(context, radvor_scene_create(context, &scene)) ||
        failed(context, radvor_scene_add_material(scene, &white, &material));
  room.material = material;
  bad = bad || failed(context, radvor_scene_add_mesh(scene, &room, &mesh)) ||
        failed(context, radvor_scene_add_light(scene, &lamp, &light)) ||
        failed(context, radvor_bake(scene, NULL, &solution)) ||
        failed(context,
               radvor_solution_vertices(solution, mesh, RADVOR_IRRADIANCE, RADVOR_VERTEX_SAMPLE, irradiance[0], 0, 8));
  for (int i = 0; i < 8 && !bad; ++i) {
    printf("corner (%g %g %g): irradiance %.3f %.3f %.3f W/m2\n", corners[i][0], corners[i][1], corners[i][2],
           irradiance[i][0], irradiance[i][1], irradiance[i][2]);
  }
  radvor_solution_destroy(solution);
  radvor_scene_destroy(scene);
  radvor_context_destroy(context);
  return bad ? 1 : 0;
}
