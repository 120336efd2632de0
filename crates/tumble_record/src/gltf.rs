//! glTF: the recording as one animated file that viewers of models open (`scene.gltf`, glTF 2.0).
//!
//! A node per body, named as the body, under one root node that turns the way up, against gravity, to the y axis of glTF; metres and
//! seconds stay. Positions and unit quaternions of the samples are its animation, interpolated linearly; from sample to sample a
//! quaternion and its opposite, which are the same rotation, are chosen to be near. A body that is not in the world has size 0.
//! Springs and joints are nodes of their own, which move and stretch with what they hold; contacts come and go and are not in the file.
//! Shapes of the plane are thin solids around z = 0. All numbers are in the file, as base64 of 32-bit floats.

use glam::{DQuat, DVec3};
use serde_json::{Value, json};

use crate::dim::RecordDim;
use crate::fittings::{HOLD, Placement, holds};
use crate::mesh::Mesh;
use crate::recording::Recording;
use crate::replay::base64;
use crate::stage::{Stage, to_y_up};

/// Type of a 32-bit float in glTF.
const FLOAT: u32 = 5126;
/// Type of a 32-bit index in glTF.
const INDEX: u32 = 5125;

/// Writes the recording as the text of a glTF file.
pub fn to_gltf<D: RecordDim>(recording: &Recording<D>) -> String {
    let stage = Stage::new(recording);
    let mut file = File::default();
    let times: Vec<(usize, f32)> = rising(recording.samples.iter().map(|sample| sample.time)).collect();
    let surfaces: Vec<Surface> = stage.meshes.iter().map(|mesh| file.add_surface(mesh)).collect();
    for (index, body) in stage.bodies.iter().enumerate() {
        let primitives: Vec<Value> = body
            .parts
            .iter()
            .map(|part| surfaces[part.mesh].primitive(file.material(body.color, part.sensor)))
            .collect();
        let mut node = json!({ "name": recording.bodies[index].name });
        if !primitives.is_empty() {
            node["mesh"] = file.meshes.len().into();
            file.meshes.push(json!({ "primitives": primitives }));
        }
        let place = |sample: usize| Stage::pose(&recording.samples[sample], index);
        let placements =
            times.iter().map(|&(sample, time)| (time, place(sample).map(|pose| Placement { pose, stretch: 1.0 })));
        file.add_node(node, &placements.collect::<Vec<_>>());
    }
    for hold in holds(recording, &stage) {
        let primitive = file.add_surface(&hold.mesh).primitive(file.material(HOLD, false));
        let node = json!({ "name": hold.name, "mesh": file.meshes.len() });
        file.meshes.push(json!({ "primitives": [primitive] }));
        let placements = times.iter().map(|&(sample, time)| (time, hold.placements[sample]));
        file.add_node(node, &placements.collect::<Vec<_>>());
    }
    file.finish(&recording.scene, to_y_up(stage.up))
}

/// The samples whose times still differ as 32-bit floats, each with its time [s].
fn rising(times: impl Iterator<Item = f64>) -> impl Iterator<Item = (usize, f32)> {
    let mut last = None;
    times.enumerate().filter_map(move |(sample, time)| {
        let time = time as f32;
        let rises = last.is_none_or(|last| time > last);
        last = if rises { Some(time) } else { last };
        rises.then_some((sample, time))
    })
}

/// The parts of a file, as they come together.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    known_materials: Vec<([u8; 3], bool)>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

/// Accessors of a mesh.
struct Surface {
    positions: usize,
    normals: usize,
    colors: usize,
    triangles: usize,
}

impl Surface {
    fn primitive(&self, material: usize) -> Value {
        json!({
            "attributes": { "POSITION": self.positions, "NORMAL": self.normals, "COLOR_0": self.colors },
            "indices": self.triangles,
            "material": material,
        })
    }
}

impl File {
    fn add_surface(&mut self, mesh: &Mesh) -> Surface {
        let floats = |vectors: &[DVec3]| vectors.iter().map(|vector| vector.as_vec3().to_array()).collect::<Vec<_>>();
        let shades: Vec<[f32; 3]> = mesh.shades.iter().map(|shade| [*shade as f32; 3]).collect();
        let indices: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
        Surface {
            positions: self.add_vectors(&floats(&mesh.positions)),
            normals: self.add_vectors(&floats(&mesh.normals)),
            colors: self.add_vectors(&shades),
            triangles: self.add(&indices, 3 * mesh.triangles.len(), INDEX, "SCALAR"),
        }
    }

    /// Adds a list of vectors, with the least and the greatest of each component.
    fn add_vectors<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let accessor = self.add(&bytes, vectors.len(), FLOAT, kind);
        let bound = |pick: fn(f32, f32) -> f32| {
            let first = vectors.first().copied().unwrap_or([0.0; N]);
            vectors
                .iter()
                .fold(first, |bound, vector| std::array::from_fn(|axis| pick(bound[axis], vector[axis])))
                .to_vec()
        };
        self.accessors[accessor]["min"] = bound(f32::min).into();
        self.accessors[accessor]["max"] = bound(f32::max).into();
        accessor
    }

    /// Adds numbers as a view of the buffer with an accessor.
    fn add(&mut self, bytes: &[u8], count: usize, component: u32, kind: &str) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        let view = self.views.len() - 1;
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }));
        self.accessors.len() - 1
    }

    fn material(&mut self, color: [u8; 3], sensor: bool) -> usize {
        if let Some(known) = self.known_materials.iter().position(|known| *known == (color, sensor)) {
            return known;
        }
        let [red, green, blue] = color.map(linear);
        let opacity = if sensor { 0.25 } else { 1.0 };
        self.materials.push(json!({
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, opacity],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.7,
            },
            "alphaMode": if sensor { "BLEND" } else { "OPAQUE" },
            "doubleSided": true,
        }));
        self.known_materials.push((color, sensor));
        self.materials.len() - 1
    }

    /// Adds a node with its first placement, and the later ones as an animation if they differ.
    fn add_node(&mut self, mut node: Value, placements: &[(f32, Option<Placement>)]) {
        // Node 0 will be the root.
        let number = self.nodes.len() + 1;
        self.animate(&mut node, number, placements);
        self.nodes.push(node);
    }

    fn animate(&mut self, node: &mut Value, number: usize, placements: &[(f32, Option<Placement>)]) {
        let present: Vec<(f32, Placement)> =
            placements.iter().filter_map(|(time, placement)| Some((*time, (*placement)?))).collect();
        let Some((_, start)) = present.first() else {
            node["scale"] = json!([0.0, 0.0, 0.0]);
            return;
        };
        let mut before = start.pose.rotation.quaternion();
        let mut places: Vec<[f32; 3]> = Vec::new();
        let mut turns: Vec<[f32; 4]> = Vec::new();
        for (_, Placement { pose, .. }) in &present {
            let quaternion = pose.rotation.quaternion();
            before = if quaternion.dot(before) < 0.0 { -quaternion } else { quaternion };
            places.push(pose.position.as_vec3().to_array());
            turns.push(before.as_quat().normalize().to_array());
        }
        node["translation"] = json!(places[0]);
        node["rotation"] = json!(turns[0]);
        let times: Vec<[f32; 1]> = present.iter().map(|(time, _)| [*time]).collect();
        let moves = places.iter().any(|place| *place != places[0]);
        let turning = turns.iter().any(|turn| *turn != turns[0]);
        if moves || turning {
            let input = self.add_vectors(&times);
            if moves {
                let output = self.add_vectors(&places);
                self.add_channel(number, "translation", "LINEAR", input, output);
            }
            if turning {
                let output = self.add_vectors(&turns);
                self.add_channel(number, "rotation", "LINEAR", input, output);
            }
        }
        let size = |placement: &Option<Placement>| placement.map_or([0.0; 3], |it| [1.0, it.stretch as f32, 1.0]);
        let sizes: Vec<[f32; 3]> = placements.iter().map(|(_, placement)| size(placement)).collect();
        if sizes.iter().any(|size| *size != [1.0; 3]) {
            let times: Vec<[f32; 1]> = placements.iter().map(|(time, _)| [*time]).collect();
            let (input, output) = (self.add_vectors(&times), self.add_vectors(&sizes));
            let is_always_there = present.len() == placements.len();
            self.add_channel(number, "scale", if is_always_there { "LINEAR" } else { "STEP" }, input, output);
        }
    }

    fn add_channel(&mut self, node: usize, path: &str, interpolation: &str, input: usize, output: usize) {
        let sampler = self.samplers.len();
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": interpolation }));
        self.channels.push(json!({ "sampler": sampler, "target": { "node": node, "path": path } }));
    }

    /// Puts the file together; node 0 is the root.
    fn finish(mut self, scene: &str, turn: DQuat) -> String {
        let mut root = json!({ "name": "up is y", "rotation": turn.as_quat().normalize().to_array() });
        if !self.nodes.is_empty() {
            root["children"] = (1..=self.nodes.len()).collect::<Vec<usize>>().into();
        }
        self.nodes.insert(0, root);
        let mut file = json!({
            "asset": { "version": "2.0", "generator": "tumble" },
            "scene": 0,
            "scenes": [{ "name": scene, "nodes": [0] }],
            "nodes": self.nodes,
        });
        // Lists in glTF are never empty.
        let lists = [
            ("meshes", self.meshes),
            ("materials", self.materials),
            ("bufferViews", self.views),
            ("accessors", self.accessors),
        ];
        for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
            file[name] = list.into();
        }
        if !self.channels.is_empty() {
            file["animations"] = json!([{ "name": "motion", "samplers": self.samplers, "channels": self.channels }]);
        }
        if !self.bytes.is_empty() {
            let length = self.bytes.len();
            let uri = format!("data:application/octet-stream;base64,{}", base64(self.bytes.into_iter()));
            file["buffers"] = json!([{ "byteLength": length, "uri": uri }]);
        }
        file.to_string()
    }
}

/// A component of a colour as glTF counts it: sRGB to linear, by its square, which is near enough for the eye.
fn linear(component: u8) -> f64 {
    let share = f64::from(component) / 255.0;
    share * share
}
