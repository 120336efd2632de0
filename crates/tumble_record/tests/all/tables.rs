//! The tables read back to the same bits, whatever the names and numbers.

use std::borrow::Cow;

use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::{any, prop, prop_assert_eq, proptest};
use proptest::test_runner::{Config, RngSeed};
use tumble_math::{Planar, Spatial};
use tumble_record::tables::{
    TOUCH_COLUMNS, audit_columns, contact_columns, joint_columns, trajectory_columns, write_audit, write_contacts,
    write_joints, write_touches, write_trajectory,
};
use tumble_record::{
    AnchorRecord, AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, JointForce, JointRecord, RecordDim,
    Recording, Sample, Touch, TouchPhase,
};
use tumble_sim::Ledger;
use tumble_solver::Ending;

fn body<D: RecordDim>(id: u64, name: &str, kind: BodyKind) -> BodyRecord<D> {
    BodyRecord { id, name: name.to_owned(), kind, mass: 1.0, inertia: D::INFINITE_INERTIA, shapes: Vec::new() }
}

/// The values of a recording that differ between the dimensions.
struct Values<D: RecordDim> {
    state: BodyState<D>,
    point: D::Vector,
    normal: D::Vector,
    tangent_impulse: D::Tangent,
    force: D::Vector,
    torque: D::Angular,
}

/// Something of everything: a sample in which one body moves, one stands and one is away.
fn recording_of<D: RecordDim>(name: &str, [x, y, z, ..]: [f64; 6], values: Values<D>) -> Recording<D> {
    let Values { state, point, normal, tangent_impulse, force, torque } = values;
    let ledger =
        Ledger { work_joints: x, error: z, sticking: 3, solver_end: Some(Ending::NotConverged), ..Ledger::default() };
    let anchor = |body| AnchorRecord { body, point };
    Recording {
        dt: 0.01,
        bodies: vec![
            body(0, name, BodyKind::Dynamic),
            body(1, "floor", BodyKind::Static),
            body(2, "lift", BodyKind::Kinematic),
        ],
        samples: vec![Sample {
            step: 5,
            time: x,
            states: vec![Some(state), Some(BodyState::default()), None],
            contacts: vec![ContactRecord {
                a: 0,
                b: 1,
                point,
                normal,
                separation: z,
                normal_impulse: y,
                tangent_impulse,
                kind: Cow::Borrowed("rod_end_on_half_plane"),
            }],
            joints: vec![JointForce { joint: 0, point, force, torque }],
        }],
        joints: vec![JointRecord {
            name: name.to_owned(),
            kind: Cow::Borrowed("fixed"),
            a: anchor(None),
            b: anchor(Some(0)),
            axis: None,
            from: 0.0,
            until: None,
        }],
        audit: vec![AuditRow { step: 5, time: x, kinetic: y, residual: Some(z), ledger, ..AuditRow::default() }],
        touches: vec![Touch { step: 5, time: x, a: 0, b: 1, phase: TouchPhase::Begin, sensor: true }],
        ..Recording::default()
    }
}

fn recording(name: &str, numbers: [f64; 6]) -> Recording {
    let [x, y, angle, vx, vy, angular_velocity] = numbers;
    let state =
        BodyState { position: DVec2::new(x, y), orientation: angle, velocity: DVec2::new(vx, vy), angular_velocity };
    let values = Values {
        state,
        point: DVec2::new(x, y),
        normal: DVec2::new(0.0, -1.0),
        tangent_impulse: -0.0,
        force: DVec2::new(angle, x),
        torque: y,
    };
    recording_of(name, numbers, values)
}

fn recording_of_space(name: &str, numbers: [f64; 6]) -> Recording<Spatial> {
    let [x, y, z, u, v, w] = numbers;
    let state = BodyState {
        position: DVec3::new(x, y, z),
        orientation: DQuat::from_xyzw(u, v, w, x),
        velocity: DVec3::new(y, z, u),
        angular_velocity: DVec3::new(v, w, -0.0),
    };
    let values = Values {
        state,
        point: DVec3::new(z, y, x),
        normal: DVec3::new(0.0, -1.0, 0.0),
        tangent_impulse: DVec3::new(u, v, w),
        force: DVec3::new(w, v, u),
        torque: DVec3::new(x, x, y),
    };
    recording_of(name, numbers, values)
}

fn text(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("memory takes all");
    String::from_utf8(bytes).expect("CSV is UTF-8")
}

/// The rows of a table, each cell with the name of its column.
fn rows(csv: &str) -> Vec<Vec<(String, String)>> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let rows = reader.records().map(|row| row.expect("as many cells as columns"));
    rows.map(|row| header.iter().map(str::to_owned).zip(row.iter().map(str::to_owned)).collect()).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    let mut cells = row.iter().filter(|(column, _)| column == name);
    let (_, value) = cells.next().unwrap_or_else(|| panic!("no column `{name}`"));
    assert!(cells.next().is_none(), "`{name}` twice");
    value
}

/// The bits of the numbers in some columns, given as a list with commas.
fn bits(row: &[(String, String)], names: &str) -> Vec<u64> {
    names.split(',').map(|name| cell(row, name).parse::<f64>().expect("a number").to_bits()).collect()
}

fn bits_of(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

proptest! {
    #![proptest_config(Config { cases: 256, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() })]

    #[test]
    fn tables_read_back_to_the_same_bits(name in any::<String>(), numbers in prop::array::uniform6(any::<f64>())) {
        let recording = recording(&name, numbers);
        let [x, y, z, ..] = numbers;
        let trajectory = rows(&text(|out| write_trajectory(&recording, out)));
        prop_assert_eq!(trajectory.len(), 1, "the floor is static, the lift is not in the world");
        prop_assert_eq!(cell(&trajectory[0], "body"), name.as_str());
        prop_assert_eq!(bits(&trajectory[0], "x,y,angle,vx,vy,omega"), bits_of(&numbers));
        prop_assert_eq!(bits(&trajectory[0], "time"), bits_of(&[x]));

        let contact = &rows(&text(|out| write_contacts(&recording, out)))[0];
        prop_assert_eq!([cell(contact, "a"), cell(contact, "b")], [name.as_str(), "floor"]);
        prop_assert_eq!(cell(contact, "kind"), "rod_end_on_half_plane");
        let written = [x, y, 0.0, -1.0, z, y, -0.0];
        prop_assert_eq!(bits(contact, "x,y,nx,ny,separation,normal_impulse,tangent_impulse"), bits_of(&written));

        let joint = &rows(&text(|out| write_joints(&recording, out)))[0];
        prop_assert_eq!([cell(joint, "joint"), cell(joint, "a"), cell(joint, "b")], [name.as_str(), "", name.as_str()]);
        prop_assert_eq!(bits(joint, "x,y,fx,fy,torque"), bits_of(&[x, y, z, x, y]));

        let audit = &rows(&text(|out| write_audit(&recording, out)))[0];
        prop_assert_eq!(bits(audit, "kinetic,residual,work_joints,ledger_error"), bits_of(&[y, z, x, z]));
        prop_assert_eq!([cell(audit, "iterations"), cell(audit, "sticking")], ["", "3"]);
        prop_assert_eq!(cell(audit, "solver_end"), "not-converged");
    }

    #[test]
    fn tables_of_space_read_back_to_the_same_bits(numbers in prop::array::uniform6(any::<f64>())) {
        let recording = recording_of_space("top", numbers);
        let [x, y, z, u, v, w] = numbers;
        let body = &rows(&text(|out| write_trajectory(&recording, out)))[0];
        let written = [x, y, z, u, v, w, x, y, z, u, v, w, -0.0];
        prop_assert_eq!(bits(body, "x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz"), bits_of(&written));
        let contact = &rows(&text(|out| write_contacts(&recording, out)))[0];
        let written = [z, y, x, 0.0, -1.0, 0.0, z, y, u, v, w];
        prop_assert_eq!(bits(contact, "x,y,z,nx,ny,nz,separation,normal_impulse,tx,ty,tz"), bits_of(&written));
        let joint = &rows(&text(|out| write_joints(&recording, out)))[0];
        let written = [z, y, x, w, v, u, x, x, y];
        prop_assert_eq!(bits(joint, "x,y,z,fx,fy,fz,torque_x,torque_y,torque_z"), bits_of(&written));
    }
}

#[test]
fn awkward_names_are_quoted_as_rfc_4180_asks() {
    let name = "a \"big\", long\nname";
    let csv = text(|out| write_trajectory(&recording(name, [1.0, -0.0, 1e-7, 0.1, 1e300, 2.5]), out));
    let expected = "step,time,body,x,y,angle,vx,vy,omega\n\
                    5,1.0,\"a \"\"big\"\", long\nname\",1.0,-0.0,1e-7,0.1,1e300,2.5\n";
    assert_eq!(csv, expected);
}

#[test]
fn numbers_that_are_not_finite_can_be_read_back() {
    let numbers = [f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0, 0.0, f64::NAN];
    let rows = rows(&text(|out| write_trajectory(&recording("a", numbers), out)));
    assert_eq!(bits(&rows[0], "x,y"), bits_of(&numbers[..2]));
    assert!(cell(&rows[0], "omega").parse::<f64>().expect("a number").is_nan());
}

#[test]
fn empty_tables_have_their_header() {
    fn check<D: RecordDim>(touches: &str) {
        let empty = Recording::<D>::default();
        let tables = [
            (text(|out| write_trajectory(&empty, out)), trajectory_columns::<D>()),
            (text(|out| write_contacts(&empty, out)), contact_columns::<D>()),
            (text(|out| write_audit(&empty, out)), audit_columns::<D>()),
            (text(|out| write_joints(&empty, out)), joint_columns::<D>()),
        ];
        for (csv, columns) in tables {
            assert_eq!(csv, columns.join(",") + "\n");
        }
        assert_eq!(text(|out| write_touches(&empty, out)), touches);
    }
    check::<Planar>(&(TOUCH_COLUMNS.join(",") + "\n"));
    check::<Spatial>(&(TOUCH_COLUMNS.join(",") + "\n"));
}

#[test]
fn columns_are_those_that_other_programs_read() {
    const LEDGER: &str = "deepest_overlap,contacts,iterations,residual,normal_violation,tangent_violation,work_gravity,\
                          work_springs,work_user,work_friction,work_impacts,work_joints,work_position_correction,\
                          integrator_defect,ledger_error,sticking,sliding,solver_end";
    assert_eq!(trajectory_columns::<Planar>().join(","), "step,time,body,x,y,angle,vx,vy,omega");
    assert_eq!(
        contact_columns::<Planar>().join(","),
        "step,time,a,b,x,y,nx,ny,separation,normal_impulse,tangent_impulse,kind"
    );
    let audit = format!("step,time,kinetic,potential,total,momentum_x,momentum_y,angular_momentum,{LEDGER}");
    assert_eq!(audit_columns::<Planar>().join(","), audit);
    assert_eq!(joint_columns::<Planar>().join(","), "step,time,joint,kind,a,b,x,y,fx,fy,torque");

    assert_eq!(trajectory_columns::<Spatial>().join(","), "step,time,body,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
    assert_eq!(
        contact_columns::<Spatial>().join(","),
        "step,time,a,b,x,y,z,nx,ny,nz,separation,normal_impulse,tx,ty,tz,kind"
    );
    let sums = "momentum_x,momentum_y,momentum_z,angular_momentum_x,angular_momentum_y,angular_momentum_z";
    assert_eq!(audit_columns::<Spatial>().join(","), format!("step,time,kinetic,potential,total,{sums},{LEDGER}"));
}
