//! Data frames in Parquet files, written and read group by group.
//!
//! polars's own reader and writer of files bring along what reads other formats, from other places; this asks its Parquet library
//! alone, and a first build takes a sixth less.

use base::file::MOST_BYTES;
use polars::prelude::{
    ArrowDataType, ArrowField, ArrowSchema, Column, CompatLevel, DataFrame, PolarsError, PolarsResult,
    Schema, SchemaExt as _, Series,
};
use polars::utils::accumulate_dataframes_vertical;
use polars_parquet::parquet::compression::DecompressionContext;
use polars_parquet::read::{
    BasicDecompressor, ColumnChunkMetadata, FileMetadata, Page, PageReader, RowGroupMetadata,
    column_iter_to_arrays, decompress, infer_schema, read_metadata,
};
use polars_parquet::write::{
    CompressedPage, CompressionOptions, FileWriter, KeyValue, StatisticsOptions, Version, WriteOptions,
    get_dtype_encoding, row_group_iter, schema_to_metadata_key,
};
use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};
use std::io::{Cursor, Read, Seek, SeekFrom, Write};

/// How many rows a group has at most.
pub const GROUP_ROWS: usize = 1 << 17;

/// A page of another program may hold no more values: for each of them there must be room in memory.
const MOST_VALUES: usize = 1 << 28;

/// A page may take no more bytes, packed or not.
const MOST_OF_PAGE: usize = MOST_BYTES as usize;

const OPTIONS: WriteOptions = WriteOptions {
    statistics: StatisticsOptions {
        min_value: true,
        max_value: true,
        distinct_count: false,
        null_count: true,
        binary_statistics_truncate_length: None,
    },
    version: Version::V1,
    compression: CompressionOptions::Zstd(None),
    data_page_size: None,
};

/// A file at work: frames of the same columns, each a group or, where it is long, several.
pub struct FrameWriter<W: Write> {
    file: FileWriter<W>,
    entries: Vec<(String, String)>,
}

impl<W: Write> FrameWriter<W> {
    /// Begins a file in `out` for frames with the columns of `like`, with `entries` of names and values in its metadata.
    ///
    /// # Errors
    /// A column of a type that Parquet has not.
    pub fn new(out: W, like: &DataFrame, entries: Vec<(String, String)>) -> PolarsResult<Self> {
        let schema = like.schema().to_arrow(CompatLevel::newest());
        Ok(Self { file: FileWriter::try_new(out, schema, OPTIONS)?, entries })
    }

    /// Adds the rows of `frame`.
    ///
    /// # Errors
    /// What the system refused.
    pub fn write(&mut self, mut frame: DataFrame) -> PolarsResult<()> {
        frame.rechunk_mut();
        let encodings = self.file.schema().iter_values().map(|field| get_dtype_encoding(&field.dtype));
        let encodings: Vec<_> = encodings.collect();
        let fields = self.file.parquet_schema().fields().to_vec();
        for first in (0..frame.height()).step_by(GROUP_ROWS) {
            for batch in frame.slice(first as i64, GROUP_ROWS).iter_chunks(CompatLevel::newest(), false) {
                let rows = batch.len() as u64;
                let group = row_group_iter(batch, encodings.clone().into(), fields.clone(), OPTIONS);
                self.file.write(rows, group)?;
            }
        }
        Ok(())
    }

    /// Ends the file, and gives back what it was written to.
    ///
    /// # Errors
    /// What the system refused.
    pub fn finish(mut self) -> PolarsResult<W> {
        let entries = self.entries.into_iter().map(|(key, value)| KeyValue { key, value: Some(value) });
        let metadata = [schema_to_metadata_key(self.file.schema())].into_iter().chain(entries).collect();
        self.file.end(Some(metadata))?;
        Ok(self.file.into_inner())
    }
}

/// `frame` alone as a file, with `entries` in its metadata.
///
/// # Errors
/// As those of [`FrameWriter`].
pub fn write_frame(out: impl Write, frame: DataFrame, entries: Vec<(String, String)>) -> PolarsResult<()> {
    let mut writer = FrameWriter::new(out, &frame, entries)?;
    writer.write(frame)?;
    writer.finish().map(drop)
}

/// A file that was opened: what it says of itself is read, its rows are not.
pub struct FrameReader<R> {
    file: R,
    metadata: FileMetadata,
    schema: ArrowSchema,
}

impl<R: Read + Seek> FrameReader<R> {
    /// Opens `file`.
    ///
    /// # Errors
    /// What is no Parquet file.
    pub fn open(mut file: R) -> PolarsResult<Self> {
        let metadata = read_metadata(&mut file)?;
        let schema = infer_schema(&metadata)?;
        Ok(Self { file, metadata, schema })
    }

    /// Leaves out columns of other types than texts, numbers and booleans, and gives their names. Texts that are stored once each and
    /// numbered, as pandas stores categories, are texts.
    pub fn leave_out_others(&mut self) -> Vec<String> {
        let mut others = Vec::new();
        let mut left = ArrowSchema::default();
        for (name, field) in self.schema.iter() {
            match plain(&field.dtype) {
                Some(dtype) => drop(left.insert(name.clone(), ArrowField::new(name.clone(), dtype, true))),
                None => others.push(name.to_string()),
            }
        }
        self.schema = left;
        others
    }

    /// How many rows each group has.
    pub fn groups(&self) -> impl Iterator<Item = usize> {
        self.metadata.row_groups.iter().map(RowGroupMetadata::num_rows)
    }

    /// What the metadata says under `name`.
    pub fn entry(&self, name: &str) -> Option<&str> {
        let entries = self.metadata.key_value_metadata().iter().flatten();
        entries.filter(|entry| entry.key == name).find_map(|entry| entry.value.as_deref())
    }

    /// All rows of all columns.
    ///
    /// # Errors
    /// What is damaged.
    pub fn frame(&mut self) -> PolarsResult<DataFrame> {
        self.columns(|_| true)
    }

    /// All rows of the columns whose names are wanted.
    ///
    /// # Errors
    /// What is damaged.
    pub fn columns(&mut self, is_wanted: impl Fn(&str) -> bool) -> PolarsResult<DataFrame> {
        let groups = 0..self.metadata.row_groups.len();
        let frames = groups.map(|group| self.part(group, &is_wanted)).collect::<PolarsResult<Vec<_>>>()?;
        if frames.is_empty() {
            let fields = self.schema.iter().filter(|(name, _)| is_wanted(name));
            let schema: ArrowSchema = fields.map(|(name, field)| (name.clone(), field.clone())).collect();
            return Ok(DataFrame::empty_with_schema(&Schema::from_arrow_schema(&schema)));
        }
        accumulate_dataframes_vertical(frames)
    }

    /// The rows of one group.
    ///
    /// # Errors
    /// What is damaged.
    ///
    /// # Panics
    /// If there is no such group.
    pub fn group(&mut self, group: usize) -> PolarsResult<DataFrame> {
        self.part(group, |_| true)
    }

    fn part(&mut self, group: usize, is_wanted: impl Fn(&str) -> bool) -> PolarsResult<DataFrame> {
        let Self { file, metadata, schema } = self;
        let group = &metadata.row_groups[group];
        let wanted = schema.iter().filter(|(name, _)| is_wanted(name));
        let mut packed = Vec::new();
        for (name, field) in wanted {
            let chunks = group.columns_under_root_iter(name).into_iter().flatten();
            let chunks = chunks.map(|chunk| Ok((chunk, bytes_of(file, chunk)?)));
            packed.push((field, chunks.collect::<PolarsResult<Vec<_>>>()?));
        }
        let columns = packed.into_par_iter().map(|(field, chunks)| {
            let types =
                chunks.iter().map(|(chunk, _)| &chunk.descriptor().descriptor.primitive_type).collect();
            let pages = chunks.into_iter().map(|(chunk, bytes)| {
                Ok(BasicDecompressor::new(pages(chunk, bytes, group.num_rows())?, Vec::new()))
            });
            let pages = pages.collect::<PolarsResult<_>>()?;
            let (arrays, _) = column_iter_to_arrays(pages, types, field.clone(), None)?;
            Ok(Series::try_from((field, arrays))?.into())
        });
        DataFrame::new(group.num_rows(), columns.collect::<PolarsResult<Vec<Column>>>()?)
    }
}

/// The type that values of the type `dtype` are read as; `None` if they are neither texts nor numbers nor booleans.
fn plain(dtype: &ArrowDataType) -> Option<ArrowDataType> {
    use ArrowDataType as Type;
    match dtype {
        Type::Dictionary(_, values, _) => plain(values),
        Type::Utf8 | Type::LargeUtf8 | Type::Utf8View => Some(Type::Utf8View),
        Type::Int8 | Type::Int16 | Type::UInt8 | Type::UInt16 => Some(Type::Int32),
        Type::Boolean
        | Type::Int32
        | Type::Int64
        | Type::UInt32
        | Type::UInt64
        | Type::Float32
        | Type::Float64 => Some(dtype.clone()),
        _ => None,
    }
}

/// The pages in `bytes` of a column of a group of `rows` rows.
///
/// polars reserves memory for as many values as a column or a page claims to have, and ends the whole program where there is
/// not so much. So the claims are checked first.
fn pages(chunk: &ColumnChunkMetadata, bytes: Vec<u8>, rows: usize) -> PolarsResult<PageReader> {
    let is_flat = chunk.descriptor().descriptor.max_rep_level == 0;
    let most = if is_flat { rows.min(MOST_VALUES) } else { MOST_VALUES };
    check_claim(chunk.num_values() as usize, most)?;
    let mut pages = PageReader::new(Cursor::new(bytes.into()), chunk, Vec::new(), MOST_OF_PAGE);
    for page in &mut pages {
        let page = page?;
        if let CompressedPage::Data(page) = &page {
            check_claim(page.num_values(), most)?;
            check_claim(page.uncompressed_size(), MOST_OF_PAGE)?;
        } else if let Page::Dict(page) = decompress(page, &mut Vec::new(), &mut DecompressionContext::Unset)?
        {
            check_claim(page.num_values, page.buffer.len())?;
        }
    }
    let (mut bytes, _) = pages.into_inner();
    bytes.set_position(0);
    Ok(PageReader::new(bytes, chunk, Vec::new(), MOST_OF_PAGE))
}

/// Refuses a number of values or bytes that cannot be; one below 0 is beyond every limit.
fn check_claim(claimed: usize, most: usize) -> PolarsResult<()> {
    if claimed <= most {
        return Ok(());
    }
    let message =
        format!("a column or page claims {} values or bytes; at most {most} can be", claimed as i64);
    Err(PolarsError::ComputeError(message.into()))
}

/// The bytes of a column of a group, or as many as the file has of them.
fn bytes_of(file: &mut (impl Read + Seek), chunk: &ColumnChunkMetadata) -> PolarsResult<Vec<u8>> {
    let range = chunk.byte_range();
    file.seek(SeekFrom::Start(range.start))?;
    let mut bytes = Vec::new();
    file.take(range.end.saturating_sub(range.start)).read_to_end(&mut bytes)?;
    Ok(bytes)
}
