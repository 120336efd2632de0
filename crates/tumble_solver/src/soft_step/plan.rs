//! Where every pair goes: into packs of one colour and one size, side by side for each member of the team.

use super::colours::OVERFLOW;
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
    /// Before packs are laid out, its number among the pairs of its colour and class.
    pub pack: u32,
}

/// Stands for no member.
pub const NOBODY: u8 = u8::MAX;
/// So many members may share the packs.
pub const MEMBERS: usize = NOBODY as usize;

/// Pairs of a colour in a class, and where those of each member begin.
#[derive(Clone, Copy, Debug)]
pub struct Colour {
    pub number: usize,
    pub pairs: u32,
}

/// The packs of a class: those of each member side by side, in the order of colours.
pub struct Class<D: SoftDim, const P: usize> {
    packs: Vec<Pack<D, P>>,
    /// The colours that are used, in order.
    colours: Vec<Colour>,
    /// For each member, where its packs of each of them begin, and where they end.
    starts: Vec<u32>,
    members: usize,
}

impl<D: SoftDim, const P: usize> Default for Class<D, P> {
    fn default() -> Self {
        Self { packs: Vec::new(), colours: Vec::new(), starts: Vec::new(), members: 0 }
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
    pub fn lay_out(&mut self, colours: impl Iterator<Item = Colour>, members: usize, world: u32) {
        self.members = members;
        self.colours.clear();
        self.colours.extend(colours);
        self.starts.clear();
        let mut next = 0;
        for member in 0..members {
            for colour in &self.colours {
                let packs = packs_of(colour.number, colour.pairs);
                let first = |member: usize| before(member, members, colour.number, packs);
                self.starts.push(next);
                next += first(member + 1) - first(member);
            }
            self.starts.push(next);
        }
        if self.packs.len() < next as usize {
            self.packs.resize(next as usize, Pack::unused(world));
        }
        self.packs.truncate(next as usize);
        for at in 0..self.colours.len() {
            let Colour { number: colour, pairs } = self.colours[at];
            // Lanes without a pair are those at the end, but for pairs that go one by one.
            let first = if colour == OVERFLOW { 0 } else { pairs.saturating_sub(1) };
            for number in first..pairs {
                let (pack, lane, _) = self.place(at, number);
                (lane as usize + 1..WIDTH).for_each(|lane| self.packs[pack as usize].clear(lane, world));
            }
        }
    }

    /// Pack, lane and member of a pair by its number among those of a colour, which is `at` this place among those used.
    #[inline]
    pub fn place(&self, at: usize, number: u32) -> (u32, u8, u8) {
        let Colour { number: colour, pairs } = self.colours[at];
        let (packs, members) = (packs_of(colour, pairs), self.members);
        let (pack, lane) =
            if colour == OVERFLOW { (number, 0) } else { (number / WIDTH as u32, (number % WIDTH as u32) as u8) };
        let mut member = 0;
        while member + 1 < members && pack >= before(member + 1, members, colour, packs) {
            member += 1;
        }
        let first = self.starts[member * (self.colours.len() + 1) + at];
        (first + pack - before(member, members, colour, packs), lane, member as u8)
    }

    /// Number of packs.
    pub fn len(&self) -> usize {
        self.packs.len()
    }

    /// A pack by its number.
    pub fn pack(&self, number: u32) -> &Pack<D, P> {
        &self.packs[number as usize]
    }

    /// What each member has.
    pub fn shares(&mut self) -> impl Iterator<Item = Share<'_, D, P>> {
        let mut rest = self.packs.as_mut_slice();
        self.starts.chunks_exact(self.colours.len() + 1).map(move |starts| {
            let count = (starts[starts.len() - 1] - starts[0]) as usize;
            let (packs, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            Share { packs, starts }
        })
    }
}

/// The packs of one member.
pub struct Share<'a, D: SoftDim, const P: usize> {
    packs: &'a mut [Pack<D, P>],
    starts: &'a [u32],
}

impl<D: SoftDim, const P: usize> Share<'_, D, P> {
    /// Its packs of the colour that is `at` this place among those used.
    #[inline(always)]
    pub fn of_colour(&mut self, at: usize) -> &mut [Pack<D, P>] {
        let [from, to] = [self.starts[at], self.starts[at + 1]].map(|k| (k - self.starts[0]) as usize);
        &mut self.packs[from..to]
    }

    /// A pack by its number among those of all members.
    #[inline]
    pub fn pack(&mut self, number: u32) -> &mut Pack<D, P> {
        &mut self.packs[(number - self.starts[0]) as usize]
    }
}
