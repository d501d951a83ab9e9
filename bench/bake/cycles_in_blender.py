"""Runs inside Blender 3.4: MESH.obj POINTS.csv VALUES.csv SAMPLES LIGHTS.txt|-

Bakes diffuse light without colour to the mesh's corners and writes the irradiance at the points, interpolated over the
nearest triangle that faces along the point's normal. Fronts alone emit and reflect, as in radvor.h."""
import csv
import json
import math
import os
import sys

import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

k_bounces = 64
k_point_distance = 1e-3  # of the diagonal


def read_mesh(file):
    positions, normals, faces, materials, colours = [], [], [], [], []
    material = 0
    for line in open(file):
        words = line.split()
        if words[0] == "v":
            positions.append(tuple(map(float, words[1:])))
        elif words[0] == "vn":
            normals.append(tuple(map(float, words[1:])))
        elif words[0] == "usemtl":
            material = int(words[1])
        elif words[0] == "f":
            faces.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
            materials.append(material)
    for line in open(file + ".mtl"):
        words = line.split()
        if words[0] == "newmtl":
            colours.append({})
        else:
            colours[-1][words[0]] = tuple(map(float, words[1:]))
    return positions, normals, faces, materials, colours


def one_sided(name, colours):
    """Diffuse and emitting on the front, black on the back."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*colours["Kd"], 1)
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (*colours["Ke"], 1)
    front = nodes.new("ShaderNodeAddShader")
    back = nodes.new("ShaderNodeBsdfDiffuse")
    back.inputs["Color"].default_value = (0, 0, 0, 1)
    side = nodes.new("ShaderNodeNewGeometry")
    mix = nodes.new("ShaderNodeMixShader")
    links.new(diffuse.outputs[0], front.inputs[0])
    links.new(emission.outputs[0], front.inputs[1])
    links.new(side.outputs["Backfacing"], mix.inputs[0])
    links.new(front.outputs[0], mix.inputs[1])
    links.new(back.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs["Surface"])
    return material


def add_lights(scene, file):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    scene.world = world
    for line in open(file) if file != "-" else []:
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        numbers = list(map(float, words[1:]))
        if words[0] == "sky":
            background.inputs["Color"].default_value = (*numbers[:3], 1)
        elif words[0] == "sun":
            sun = bpy.data.lights.new("sun", "SUN")
            sun.energy, sun.color, sun.angle = 1, numbers[3:6], numbers[6] if len(numbers) > 6 else 0
            holder = bpy.data.objects.new("sun", sun)
            holder.rotation_mode = "QUATERNION"
            holder.rotation_quaternion = Vector(numbers[:3]).to_track_quat("-Z", "Y")
            scene.collection.objects.link(holder)
        else:
            sys.exit(f"a light of kind {words[0]} is not known here")


def set_up_cycles(scene, samples):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", samples, False, False
    cycles.max_bounces = cycles.diffuse_bounces = k_bounces
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.bake.target = "VERTEX_COLORS"


def write_values(mesh, faces, positions, points_file, values_file):
    colours = mesh.color_attributes[0].data
    tree = BVHTree.FromPolygons(positions, faces)
    low, high = ([f(p[axis] for p in positions) for axis in range(3)] for f in (min, max))
    reach = k_point_distance * math.dist(low, high)
    with open(points_file) as points, open(values_file, "w") as out:
        out.write("r,g,b,found\n")
        for row in csv.DictReader(points):
            at = Vector([float(row[c]) for c in "xyz"])
            normal = Vector([float(row["n" + c]) for c in "xyz"])
            near = [hit for hit in tree.find_nearest_range(at, reach) if hit[1].dot(normal) > 0]
            if not near:
                out.write("0,0,0,0\n")
                continue
            index = min(near, key=lambda hit: hit[3])[2]
            a, b, c = (Vector(positions[i]) for i in faces[index])
            area = (b - a).cross(c - a)
            weights = [(c - b).cross(at - b).dot(area), (a - c).cross(at - c).dot(area), (b - a).cross(at - a).dot(area)]
            corners = [colours[mesh.polygons[index].loop_start + i].color for i in range(3)]
            total = area.dot(area)
            out.write(",".join(repr(math.pi * sum(w / total * k[i] for w, k in zip(weights, corners))) for i in range(3)))
            out.write(",1\n")


def main():
    mesh_file, points_file, values_file, samples, lights = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    positions, normals, faces, materials, colours = read_mesh(mesh_file)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(positions, [], faces)
    for i, colour in enumerate(colours):
        mesh.materials.append(one_sided(str(i), colour))
    mesh.polygons.foreach_set("material_index", materials)
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(normals)
    mesh.color_attributes.new("light", "FLOAT_COLOR", "CORNER")
    mesh.color_attributes.active_color_index = 0
    holder = bpy.data.objects.new("mesh", mesh)
    scene.collection.objects.link(holder)
    holder.select_set(True)
    bpy.context.view_layer.objects.active = holder
    add_lights(scene, lights)
    set_up_cycles(scene, int(samples))
    begin = os.times()
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"})
    end = os.times()
    write_values(mesh, faces, positions, points_file, values_file)
    spent = (end.user + end.system) - (begin.user + begin.system)
    print(json.dumps({"cpu_seconds": spent, "corners": 3 * len(faces)}))


main()
