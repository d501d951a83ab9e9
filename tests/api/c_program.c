/* A program in C99 that uses the ABI: a floor under a lamp, whose light at the corners has a closed form. */
#include <radvor.h>
#include <stdio.h>

static void print_line(void* user, int32_t level, const char* text) {
  (void)user;
  if (level <= RADVOR_LOG_WARNING) {
    fprintf(stderr, "radvor: %s\n", text);
  }
}

/* Adds a gray material; returns its id. */
static uint32_t add_material(radvor_scene* scene, float albedo, float emission) {
  radvor_material_desc desc = {0};
  uint32_t id = RADVOR_NONE;
  int channel;
  desc.struct_size = sizeof desc;
  for (channel = 0; channel < 3; ++channel) {
    desc.albedo[channel] = albedo;
    desc.emission[channel] = emission;
  }
  radvor_scene_add_material(scene, &desc, &id);
  return id;
}

int main(void) {
  /* Front faces wind counter-clockwise: the floor faces up, the lamp down. */
  const float positions[][3] = {{0, 0, 0},       {0, 0, 1},       {1, 0, 1},       {1, 0, 0},        /* floor */
                                {0.4f, 1, 0.4f}, {0.6f, 1, 0.4f}, {0.6f, 1, 0.6f}, {0.4f, 1, 0.6f}}; /* lamp */
  const uint16_t indices[][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  uint32_t materials[4];
  float irradiance[8][3];
  uint32_t mesh_id = RADVOR_NONE, i;
  radvor_context_desc lent = {0};
  radvor_mesh_desc mesh = {0};
  radvor_context* context = NULL;
  radvor_scene* scene = NULL;
  radvor_solution* solution = NULL;
  radvor_result result;

  lent.struct_size = sizeof lent;
  lent.log = print_line;
  if (radvor_context_create(&lent, &context) < 0) {
    return 1; /* the log has said why */
  }
  radvor_scene_create(context, &scene);
  materials[0] = materials[1] = add_material(scene, 0.7f, 0);
  materials[2] = materials[3] = add_material(scene, 0, 10);

  mesh.struct_size = sizeof mesh;
  mesh.positions = &positions[0][0];
  mesh.vertex_count = 8;
  mesh.indices = indices;
  mesh.index_size = sizeof indices[0][0];
  mesh.triangle_count = 4;
  mesh.triangle_materials = materials;
  result = radvor_scene_add_mesh(scene, &mesh, &mesh_id);

  if (result >= 0) {
    result = radvor_bake(scene, NULL, &solution);
  }
  if (result >= 0) {
    result =
        radvor_solution_vertices(solution, mesh_id, RADVOR_IRRADIANCE, RADVOR_VERTEX_SAMPLE, &irradiance[0][0], 0, 8);
  }
  if (result >= 0) {
    for (i = 0; i < 4; ++i) {
      printf("floor vertex %u: %.4f W/m^2\n", (unsigned)i, (double)irradiance[i][0]);
    }
  }
  radvor_solution_destroy(solution);
  radvor_scene_destroy(scene);
  radvor_context_destroy(context);
  return result < 0;
}
