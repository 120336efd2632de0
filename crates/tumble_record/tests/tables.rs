//! The tables read back to the same bits, whatever the names and numbers.

use std::borrow::Cow;

use glam::DVec2;
use proptest::prelude::{any, prop, prop_assert_eq, proptest};
use proptest::test_runner::{Config, RngSeed};
use serde::de::DeserializeOwned;
use tumble_record::tables::{
    AUDIT_COLUMNS, AuditCsvRow, CONTACT_COLUMNS, ContactRow, TOUCH_COLUMNS, TRAJECTORY_COLUMNS, TouchRow,
    TrajectoryRow, write_audit, write_contacts, write_touches, write_trajectory,
};
use tumble_record::{
    AnchorRecord, AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, JointForce, JointRecord, LedgerRecord,
    Recording, Sample, SolverEnd, Touch, TouchPhase,
};

fn body(id: u64, name: &str, kind: BodyKind) -> BodyRecord {
    BodyRecord { id, name: name.to_owned(), kind, mass: 1.0, inertia: 1.0, shapes: Vec::new() }
}

fn state(numbers: [f64; 6]) -> Option<BodyState> {
    let [x, y, angle, vx, vy, angular_velocity] = numbers;
    Some(BodyState { position: DVec2::new(x, y), angle, velocity: DVec2::new(vx, vy), angular_velocity })
}

fn recording(name: &str, numbers: [f64; 6]) -> Recording {
    let [x, y, angle, ..] = numbers;
    let ledger = LedgerRecord {
        work_joints: x,
        ledger_error: angle,
        sticking: 3,
        solver_end: Some(SolverEnd::NotConverged),
        ..LedgerRecord::default()
    };
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
            states: vec![state(numbers), state([0.0; 6]), None],
            contacts: vec![ContactRecord {
                a: 0,
                b: 1,
                point: DVec2::new(x, y),
                normal: DVec2::new(0.0, -1.0),
                separation: angle,
                normal_impulse: y,
                tangent_impulse: -0.0,
                kind: Cow::Borrowed("rod_end_on_half_plane"),
            }],
            joints: vec![JointForce { joint: 0, point: DVec2::new(y, x), force: DVec2::new(angle, x), torque: y }],
        }],
        joints: vec![JointRecord {
            name: name.to_owned(),
            kind: Cow::Borrowed("fixed"),
            a: AnchorRecord { body: None, point: DVec2::ZERO },
            b: AnchorRecord { body: Some(0), point: DVec2::ZERO },
            axis: None,
            from: 0.0,
            until: None,
        }],
        audit: vec![AuditRow { step: 5, time: x, kinetic: y, residual: Some(angle), ledger, ..AuditRow::default() }],
        touches: vec![Touch { step: 5, time: x, a: 0, b: 1, phase: TouchPhase::Begin, sensor: true }],
        ..Recording::default()
    }
}

fn text(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("memory takes all");
    String::from_utf8(bytes).expect("CSV is UTF-8")
}

fn rows<R: DeserializeOwned>(csv: &str) -> Vec<R> {
    csv::Reader::from_reader(csv.as_bytes()).deserialize().collect::<Result<_, _>>().expect("the rows can be read back")
}

proptest! {
    #![proptest_config(Config { cases: 256, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() })]

    #[test]
    fn trajectory_reads_back_to_the_same_bits(name in any::<String>(), numbers in prop::array::uniform6(any::<f64>())) {
        let csv = text(|out| write_trajectory(&recording(&name, numbers), out));
        let rows: Vec<TrajectoryRow<'static>> = rows(&csv);
        prop_assert_eq!(rows.len(), 1, "the floor is static, the lift is not in the world");
        let row = &rows[0];
        prop_assert_eq!(&*row.body, name.as_str());
        let read = [row.x, row.y, row.angle, row.vx, row.vy, row.omega];
        prop_assert_eq!(read.map(f64::to_bits), numbers.map(f64::to_bits));
        prop_assert_eq!(row.time.to_bits(), numbers[0].to_bits());
    }

    #[test]
    fn contacts_and_audit_read_back_to_the_same_bits(name in any::<String>(), numbers in prop::array::uniform6(any::<f64>())) {
        let recording = recording(&name, numbers);
        let contacts: Vec<ContactRow<'static>> = rows(&text(|out| write_contacts(&recording, out)));
        let contact = &contacts[0];
        prop_assert_eq!((&*contact.a, &*contact.b, &*contact.kind), (name.as_str(), "floor", "rod_end_on_half_plane"));
        let read = [contact.x, contact.y, contact.separation, contact.normal_impulse, contact.tangent_impulse];
        let written = [numbers[0], numbers[1], numbers[2], numbers[1], -0.0];
        prop_assert_eq!(read.map(f64::to_bits), written.map(f64::to_bits));

        let audit: Vec<AuditCsvRow> = rows(&text(|out| write_audit(&recording, out)));
        prop_assert_eq!(audit[0].kinetic.to_bits(), numbers[1].to_bits());
        prop_assert_eq!(audit[0].residual.map(f64::to_bits), Some(numbers[2].to_bits()));
        prop_assert_eq!(audit[0].iterations, None);
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
    let rows: Vec<TrajectoryRow<'static>> = rows(&text(|out| write_trajectory(&recording("a", numbers), out)));
    assert_eq!([rows[0].x, rows[0].y], [f64::INFINITY, f64::NEG_INFINITY]);
    assert!(rows[0].omega.is_nan());
}

#[test]
fn empty_tables_have_their_header() {
    let empty = Recording::default();
    let tables: [(String, &[&str]); 4] = [
        (text(|out| write_trajectory(&empty, out)), &TRAJECTORY_COLUMNS),
        (text(|out| write_contacts(&empty, out)), &CONTACT_COLUMNS),
        (text(|out| write_audit(&empty, out)), &AUDIT_COLUMNS),
        (text(|out| write_touches(&empty, out)), &TOUCH_COLUMNS),
    ];
    for (csv, columns) in tables {
        assert_eq!(csv, columns.join(",") + "\n");
    }
}

#[test]
fn headers_are_the_fields_of_the_rows_in_their_order() {
    // Reading by position and reading by name must agree; a header in another order would make them differ.
    let recording = recording("a", [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    fn header_of<R: DeserializeOwned + serde::Serialize>(csv: &str) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        rows::<R>(csv).iter().for_each(|row| writer.serialize(row).expect("memory takes all"));
        let again = String::from_utf8(writer.into_inner().expect("memory takes all")).expect("CSV is UTF-8");
        assert_eq!(again, csv, "serde derives the same table, header included");
        again.lines().next().expect("a header").to_owned()
    }
    assert_eq!(
        header_of::<TrajectoryRow<'static>>(&text(|out| write_trajectory(&recording, out))),
        TRAJECTORY_COLUMNS.join(",")
    );
    assert_eq!(
        header_of::<ContactRow<'static>>(&text(|out| write_contacts(&recording, out))),
        CONTACT_COLUMNS.join(",")
    );
    assert_eq!(header_of::<AuditCsvRow>(&text(|out| write_audit(&recording, out))), AUDIT_COLUMNS.join(","));
    assert_eq!(header_of::<TouchRow<'static>>(&text(|out| write_touches(&recording, out))), TOUCH_COLUMNS.join(","));
}
