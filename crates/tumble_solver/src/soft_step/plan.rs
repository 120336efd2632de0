//! Where every pair goes: into packs of one colour and one size, side by side for each member of the team.

use super::colours::{COLOURS, OVERFLOW};
use super::dim::SoftDim;
use super::lanes::WIDTH;
use super::pack::Pack;

/// How many points the packs of a class have room for.
pub const ROOM: [usize; 3] = [1, 2, 4];

/// Where a pair went.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    pub colour: u8,
    pub class: u8,
    pub lane: u8,
    pub member: u8,
    pub pack: u32,
}

/// Stands for no member.
pub const NOBODY: u8 = u8::MAX;
/// So many members may share the packs.
pub const MEMBERS: usize = NOBODY as usize;

/// The packs of a class: those of each member side by side, in the order of colours.
pub struct Class<D: SoftDim, const P: usize> {
    packs: Vec<Pack<D, P>>,
    /// For each member, where its packs of each colour begin.
    starts: Vec<[u32; COLOURS + 1]>,
}

impl<D: SoftDim, const P: usize> Default for Class<D, P> {
    fn default() -> Self {
        Self { packs: Vec::new(), starts: Vec::new() }
    }
}

/// Packs that so many pairs of a colour take: those that share bodies go one by one.
fn packs_of(colour: usize, pairs: u32) -> u32 {
    if colour == OVERFLOW { pairs } else { pairs.div_ceil(WIDTH as u32) }
}

/// Packs of a colour that members before this one have.
fn before(member: usize, members: usize, colour: usize, packs: u32) -> u32 {
    // Those that are solved one by one all go to the first.
    let member = if colour == OVERFLOW && member > 0 { members } else { member };
    (u64::from(packs) * member as u64 / members as u64) as u32
}

impl<D: SoftDim, const P: usize> Class<D, P> {
    /// Makes room for so many pairs of each colour, and leaves lanes beyond them without a pair.
    pub fn lay_out(&mut self, counts: &[u32; COLOURS], members: usize, world: u32) {
        self.starts.resize(members, [0; COLOURS + 1]);
        let mut next = 0;
        for (member, starts) in self.starts.iter_mut().enumerate() {
            for (colour, pairs) in counts.iter().enumerate() {
                let packs = packs_of(colour, *pairs);
                starts[colour] = next;
                next += before(member + 1, members, colour, packs) - before(member, members, colour, packs);
            }
            starts[COLOURS] = next;
        }
        self.packs.resize(next as usize, Pack::unused(world));
        for (colour, pairs) in counts.iter().enumerate().filter(|(_, pairs)| **pairs > 0) {
            if colour == OVERFLOW {
                for number in 0..*pairs {
                    let (pack, _, _) = self.place(colour, number, *pairs);
                    (1..WIDTH).for_each(|lane| self.packs[pack as usize].clear(lane, world));
                }
            } else {
                let (pack, lane, _) = self.place(colour, pairs - 1, *pairs);
                (lane as usize + 1..WIDTH).for_each(|lane| self.packs[pack as usize].clear(lane, world));
            }
        }
    }

    /// Pack, lane and member of a pair by its number among those of a colour.
    pub fn place(&self, colour: usize, number: u32, pairs: u32) -> (u32, u8, u8) {
        let (packs, members) = (packs_of(colour, pairs), self.starts.len());
        let (pack, lane) =
            if colour == OVERFLOW { (number, 0) } else { (number / WIDTH as u32, (number % WIDTH as u32) as u8) };
        let mut member = 0;
        while pack >= before(member + 1, members, colour, packs) {
            member += 1;
        }
        let first = self.starts[member][colour];
        (first + pack - before(member, members, colour, packs), lane, member as u8)
    }

    /// A pack by its number.
    pub fn pack(&self, number: u32) -> &Pack<D, P> {
        &self.packs[number as usize]
    }

    /// What each member has.
    pub fn shares(&mut self) -> impl Iterator<Item = Share<'_, D, P>> {
        let mut rest = self.packs.as_mut_slice();
        self.starts.iter().map(move |starts| {
            let count = (starts[COLOURS] - starts[0]) as usize;
            let (packs, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            Share { packs, starts }
        })
    }
}

/// The packs of one member.
pub struct Share<'a, D: SoftDim, const P: usize> {
    packs: &'a mut [Pack<D, P>],
    starts: &'a [u32; COLOURS + 1],
}

impl<D: SoftDim, const P: usize> Share<'_, D, P> {
    /// Its packs of a colour.
    #[inline(always)]
    pub fn of_colour(&mut self, colour: usize) -> &mut [Pack<D, P>] {
        let [from, to] = [self.starts[colour], self.starts[colour + 1]].map(|k| (k - self.starts[0]) as usize);
        &mut self.packs[from..to]
    }

    /// A pack by its number among those of all members.
    pub fn pack(&mut self, number: u32) -> &mut Pack<D, P> {
        &mut self.packs[(number - self.starts[0]) as usize]
    }
}
